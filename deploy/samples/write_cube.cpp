#include "deploy/samples/write_cube.h"

#include <fitsio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <thread>
#include <vector>

#include "common/base/workers.h"

namespace shearwater::samples {

namespace {

using base::Code;

// cfitsio's handle on a file that is removed again unless it is kept.
class Draft {
  public:
    Draft(const std::string& path, const volume::Index3& n, int bitpix)
        : name_(path + ".part" + std::to_string(::getpid())) {
        std::remove(name_.c_str());
        std::array<LONGLONG, 3> lengths = {n[0], n[1], n[2]};
        fits_create_diskfile(&file_, name_.c_str(), &status_);
        fits_create_imgll(file_, bitpix, 3, lengths.data(), &status_);
    }
    ~Draft() {
        if (file_ != nullptr) {
            int ignored = 0;
            fits_close_file(file_, &ignored);
        }
        if (!kept_) {
            std::remove(name_.c_str());
        }
    }
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;

    // The first status other than 0 of all that was done; once it is set nothing more is.
    int status() const { return status_; }

    void describe(const Description& description) {
        write_text("OBJECT", description.object);
        write_text("BUNIT", description.unit);
        for (std::size_t i = 0; i < description.axes.size(); ++i) {
            const WorldAxis& axis = description.axes[i];
            const std::string number = std::to_string(i + 1);
            write_text("CTYPE" + number, axis.type);
            write_text("CUNIT" + number, axis.unit);
            write_number("CRVAL" + number, axis.at);
            write_number("CRPIX" + number, axis.pixel_at);
            write_number("CDELT" + number, axis.step);
        }
        for (const auto& [keyword, value] : description.keywords) {
            write_number(keyword, value);
        }
    }

    void append(std::span<float> values) {
        const auto count = static_cast<LONGLONG>(values.size());
        fits_write_img(file_, TFLOAT, written_ + 1, count, values.data(), &status_);
        written_ += count;
    }

    // Closes the file and gives it its name.
    base::Status keep(const std::string& path, const std::string& operation) {
        fits_close_file(file_, &status_);
        file_ = nullptr;
        if (status_ != 0) {
            return fault(operation);
        }
        if (std::rename(name_.c_str(), path.c_str()) != 0) {
            return base::error(Code::io, operation, std::strerror(errno));
        }
        kept_ = true;
        return {};
    }

    base::Error fault(const std::string& operation) const {
        std::array<char, FLEN_STATUS> text{};
        fits_get_errstatus(status_, text.data());
        fits_clear_errmsg();
        return base::error(Code::io, operation, base::printable(text.data()));
    }

  private:
    void write_text(const std::string& keyword, std::string value) {
        if (!value.empty()) {
            fits_write_key(file_, TSTRING, keyword.c_str(), value.data(), nullptr, &status_);
        }
    }
    void write_number(const std::string& keyword, double value) {
        fits_write_key(file_, TDOUBLE, keyword.c_str(), &value, nullptr, &status_);
    }

    std::string name_;
    fitsfile* file_ = nullptr;
    LONGLONG written_ = 0;
    int status_ = 0;
    bool kept_ = false;
};

void round(std::span<float> values) {
    for (float& value : values) {
        value = std::nearbyint(value);
    }
}

base::Status check_space(const std::string& path, std::uintmax_t bytes, const std::string& operation) {
    std::error_code fault;
    const auto folder = std::filesystem::absolute(path, fault).parent_path();
    const auto space = std::filesystem::space(folder, fault);
    if (!fault && space.available < bytes) {
        return base::error(Code::too_large, operation,
                           std::to_string(bytes >> 20) + " MiB are needed, " +
                               std::to_string(space.available >> 20) + " MiB are free");
    }
    return {};
}

}  // namespace

base::Status write_cube(const Formula& formula, const volume::Index3& n, int bitpix, const std::string& path,
                        const volume::Progress& progress, const std::stop_token& stop) {
    const std::string operation = "write " + path;
    const auto plane = static_cast<std::size_t>(n[0] * n[1]);
    const std::uintmax_t bytes_each = bitpix == 8 ? 1 : sizeof(float);
    const auto bytes = static_cast<std::uintmax_t>(volume::voxel_count(n)) * bytes_each;
    if (base::Status space = check_space(path, bytes, operation); !space) {
        return space;
    }
    Draft draft(path, n, bitpix);
    draft.describe(formula.description());
    constexpr int most_threads = 8;  // each holds a plane
    base::Workers workers(std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, most_threads));
    std::vector<std::vector<float>> planes(static_cast<std::size_t>(workers.threads()),
                                           std::vector<float>(plane));
    for (std::int64_t z = 0; z < n[2] && draft.status() == 0; z += workers.threads()) {
        const std::int64_t count = std::min<std::int64_t>(workers.threads(), n[2] - z);
        workers.for_each(count,
                         [&](std::int64_t i) { formula.plane(z + i, planes[static_cast<std::size_t>(i)]); });
        if (stop.stop_requested()) {
            return base::error(Code::cancelled, operation, "stopped");
        }
        for (std::int64_t i = 0; i < count; ++i) {
            std::vector<float>& values = planes[static_cast<std::size_t>(i)];
            if (bitpix == 8) {
                round(values);  // cfitsio would cut off
            }
            draft.append(values);
        }
        if (progress) {
            progress(static_cast<double>(z + count) / static_cast<double>(n[2]));
        }
    }
    return draft.status() == 0 ? draft.keep(path, operation) : base::Status(draft.fault(operation));
}

}  // namespace shearwater::samples
