#pragma once
// The text that a picture carries along: an iTXt chunk (PNG 1.2, 4.2.3.3) with a keyword of ours, not
// compressed, behind the header.
//
//   | signature | IHDR | iTXt | ... | IDAT | ... | IEND |      a chunk: | length | type | data | CRC |

#include <cstdint>
#include <string>
#include <vector>

namespace shearwater::image {

// Into a whole PNG.
void put_png_note(std::vector<std::uint8_t>& png, const std::string& note);

}  // namespace shearwater::image
