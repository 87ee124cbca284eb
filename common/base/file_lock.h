#pragma once
// What one process at a time may hold, of all that see a file system, and that ends with the process however
// it ends: a number of a process says nothing on another machine, in another container or once it is reused.

#include <optional>
#include <string>

namespace shearwater::base {

class FileLock {
  public:
    // Makes the file, which is to be used for nothing else; nothing where another holds it, or where it or a
    // lock cannot be had.
    static std::optional<FileLock> take(const std::string& path);
    // Gives it up and removes the file.
    ~FileLock();
    FileLock(FileLock&& other) noexcept;
    FileLock& operator=(FileLock&& other) noexcept;

  private:
    FileLock(std::string path, int file) : path_(std::move(path)), file_(file) {}
    void give_up();

    std::string path_;
    int file_ = -1;
};

}  // namespace shearwater::base
