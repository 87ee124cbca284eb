#pragma once
// A file of the C library's, closed when its owner goes.

#include <cstdio>
#include <memory>

namespace shearwater::image {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

}  // namespace shearwater::image
