#pragma once
// The file of recent connections, read and written on a thread of its own. Several windows may change it:
// each change is made to what the file holds then.

#include <functional>
#include <optional>
#include <string>

#include "client/model/recent.h"
#include "client/view/errands.h"

namespace shearwater::ui {

class RecentFile {
  public:
    // Reads it. `wake` is called from the file's thread when there is something to collect.
    explicit RecentFile(std::function<void()> wake);

    void add(const model::Recent& recent);
    void remove(const std::string& name);

    struct Outcome {
        model::RecentList list;
        std::string fault;  // what is wrong with the file, or empty
    };
    std::optional<Outcome> collect() { return errands_.collect(); }

  private:
    void change(std::function<void(model::RecentList&)> change);

    Errands<Outcome> errands_;
};

}  // namespace shearwater::ui
