#pragma once
// cfitsio's handle, owned, and its status turned into our Error.

#include <fitsio.h>

#include <memory>
#include <string>

#include "common/base/result.h"
#include "common/fits/bytes.h"

namespace shearwater::fits {

struct CloseFile {
    void operator()(fitsfile* file) const;
};
using Handle = std::unique_ptr<fitsfile, CloseFile>;

// What cfitsio says of a status, with the oldest entry of its error stack, printable. Clears the stack.
base::Error cfitsio_error(int status, const std::string& operation);

// An unpacked file is read where it lies in memory, which must outlive the handle and stay in place:
// cfitsio keeps the addresses of both variables.
struct MemoryFile {
    void* data = nullptr;
    std::size_t size = 0;
};
base::Result<Handle> open_memory(MemoryFile& memory, const std::string& operation);

// A plain name: cfitsio takes no brackets or other special characters in it for anything else.
base::Result<Handle> open_disk(const std::string& path, const std::string& operation);

}  // namespace shearwater::fits
