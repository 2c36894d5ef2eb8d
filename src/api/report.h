// The report: from the statuses, counts and costs of a call to the caller's struct, whose size may
// be that of an older version. Lengths leave in his units.
#pragma once

#include "num/scale.h"
#include "surface.h"
#include "wireskin.h"

namespace wireskin::api {

// The struct of the first release; a smaller size means that the caller forgot to initialise.
inline constexpr size_t k_report_size = offsetof(wsk_report, total_ms) + sizeof(double);

void report_counts(const Counts& counts, const Scale& unscale, wsk_report* report);
void report_costs(Context& context, wsk_report* report);

// Writes the status into `report` and copies it out, as much of it as the caller's version has.
wsk_status finish(const Status& status, wsk_report* report, wsk_report* out);

}  // namespace wireskin::api
