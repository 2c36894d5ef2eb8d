// Compression into the zlib format (P. Deutsch, J.-L. Gailly, RFC 1950 and RFC 1951, 1996):
// repeated strings found through chains of equal three-byte beginnings, then one Huffman code for
// every block.
//
// Cost: linear but for the chains, which are followed a bounded number of steps.
#pragma once

#include <string>
#include <string_view>

namespace wireskin_cli {

std::string zlib_bytes(std::string_view data);

}  // namespace wireskin_cli
