#include "common/base/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <utility>

namespace shearwater::base {

namespace {

// Whoever had it may have removed it between our opening it and its lock: then ours locks nobody out.
bool is_still_there(int file, const std::string& path) {
    struct stat ours = {}, there = {};
    return fstat(file, &ours) == 0 && stat(path.c_str(), &there) == 0 && ours.st_dev == there.st_dev &&
           ours.st_ino == there.st_ino;
}

}  // namespace

std::optional<FileLock> FileLock::take(const std::string& path) {
    constexpr int most_tries = 8;
    for (int tries = 0; tries < most_tries; ++tries) {
        const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
        if (file < 0) {
            return std::nullopt;
        }
        if (flock(file, LOCK_EX | LOCK_NB) != 0) {
            close(file);
            return std::nullopt;
        }
        if (is_still_there(file, path)) {
            return FileLock(path, file);
        }
        close(file);
    }
    return std::nullopt;
}

FileLock::~FileLock() {
    give_up();
}
FileLock::FileLock(FileLock&& other) noexcept
    : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
    if (this != &other) {
        give_up();
        path_ = std::move(other.path_);
        file_ = std::exchange(other.file_, -1);
    }
    return *this;
}

// Removed while it is held: nobody else has it then.
void FileLock::give_up() {
    if (file_ >= 0) {
        unlink(path_.c_str());
        close(std::exchange(file_, -1));
    }
}

}  // namespace shearwater::base
