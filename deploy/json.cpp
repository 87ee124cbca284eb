#include "deploy/json.h"

#include "common/base/result.h"

namespace shearwater::deploy {

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : base::printable(text)) {
        if (c == '"' || c == '\\') {
            out += '\\';
        }
        out += c;
    }
    return out + '"';
}

}  // namespace shearwater::deploy
