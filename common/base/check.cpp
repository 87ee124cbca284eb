#include "common/base/check.h"

#include <cstdio>
#include <cstdlib>

namespace shearwater::base {

void check_failed(std::string_view what, const boost::source_location& where) {
    std::fprintf(stderr, "check failed: %.*s (%s:%u, %s)\n", static_cast<int>(what.size()), what.data(),
                 where.file_name(), static_cast<unsigned>(where.line()), where.function_name());
    std::abort();
}

}  // namespace shearwater::base
