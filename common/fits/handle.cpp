#include "common/fits/handle.h"

#include <array>

namespace shearwater::fits {

void CloseFile::operator()(fitsfile* file) const {
    int status = 0;
    fits_close_file(file, &status);
    fits_clear_errmsg();
}

base::Error cfitsio_error(int status, const std::string& operation) {
    std::array<char, FLEN_STATUS> brief{};
    std::array<char, FLEN_ERRMSG> entry{};
    fits_get_errstatus(status, brief.data());
    std::string detail = base::printable(brief.data());
    if (fits_read_errmsg(entry.data()) != 0) {
        detail += " (" + base::printable(entry.data()) + ")";
    }
    fits_clear_errmsg();
    return base::error(
        status == FILE_NOT_OPENED || status == READ_ERROR ? base::Code::io : base::Code::corrupt, operation,
        detail);
}

base::Result<Handle> open_memory(MemoryFile& memory, const std::string& operation) {
    fitsfile* file = nullptr;
    int status = 0;
    fits_open_memfile(&file, "memory", READONLY, &memory.data, &memory.size, 0, nullptr, &status);
    if (status != 0) {
        return cfitsio_error(status, operation);
    }
    return Handle(file);
}

base::Result<Handle> open_disk(const std::string& path, const std::string& operation) {
    if (path.size() >= FLEN_FILENAME) {
        return base::error(base::Code::unsupported, operation, "the file's name is too long");
    }
    fitsfile* file = nullptr;
    int status = 0;
    fits_open_diskfile(&file, path.c_str(), READONLY, &status);
    if (status != 0) {
        return cfitsio_error(status, operation);
    }
    return Handle(file);
}

}  // namespace shearwater::fits
