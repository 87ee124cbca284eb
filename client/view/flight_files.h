#pragma once
// Flight paths as files, read and written on a thread of their own.

#include <string>

#include "client/view/errands.h"
#include "common/flight/path.h"

namespace shearwater::ui {

class FlightFiles {
  public:
    // `wake` is called from that thread when there is something to collect.
    explicit FlightFiles(std::function<void()> wake) : errands_(std::move(wake)) {}

    void save(const std::string& file, const flight::Path& path);
    void open(const std::string& file);

    struct Outcome {
        std::string words;  // what was done, or what is wrong
        bool is_fault = false;
        std::optional<flight::Path> opened;
    };
    std::optional<Outcome> collect() { return errands_.collect(); }

  private:
    Errands<Outcome> errands_;
};

}  // namespace shearwater::ui
