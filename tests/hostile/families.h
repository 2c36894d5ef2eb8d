// Networks that no one draws on purpose, but files and devices bring: families of hostile input,
// each with a few members.
#pragma once

#include <string>
#include <vector>

#include "support/scenes.h"

namespace hostile {

struct Case {
  std::string name;
  std::vector<scenes::Curve> curves;
};

std::vector<Case> all();

}  // namespace hostile
