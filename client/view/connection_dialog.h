#pragma once
// Asks where a cube is: a line for the place, a server's secret or the file of it, and where the person has
// been. A secret that is typed is shown as dots, handed on once, and kept nowhere.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client/model/place.h"
#include "client/model/recent.h"
#include "client/view/desk.h"
#include "protocol/link/secret.h"

namespace shearwater::ui {

class ConnectionDialog {
  public:
    // `name`, `secret_file`: to begin with, where there is something to begin with. `fault`, `advice`: why it
    // is there (again), and what to do about it.
    void open(const model::Recent& begin = {}, std::string fault = {}, std::string advice = {});
    // What was typed last stays.
    void reopen(std::string fault, std::string advice);
    void close();
    bool is_open() const { return open_; }

    // What was asked in one pass.
    struct Wish {
        std::optional<model::Recent> connect;  // its name as it was typed
        bool typed_secret = false;             // there is one, to be taken
        std::optional<std::string> forget;     // of the recent ones
        bool close = false;
    };
    // `may_close`: there is something behind it to go back to. `remark`: of the list, or empty.
    Wish draw(Desk& desk, std::span<const model::Recent> recent, const std::string& remark, bool may_close);

    // The secret that was typed, and nothing is left of it here.
    base::Result<link::Secret> take_secret();

  private:
    enum class SecretBy { typing, file };

    Wish draw_content(Desk& desk, std::span<const model::Recent> recent, const std::string& remark,
                      bool may_close);
    bool place_field(Desk& desk);
    bool secret_field(Desk& desk);
    void recent_rows(Desk& desk, std::span<const model::Recent> recent, Wish& wish);
    void classify();
    bool is_server() const { return read_ && read_->kind == model::Place::Kind::server; }
    // The keys go there first when it is the secret that is missing or wrong, as far as can be told.
    bool asks_for_secret() const { return is_server() && !fault_.empty() && secret_by_ == SecretBy::typing; }

    bool open_ = false;
    bool appearing_ = false;
    std::array<char, model::RecentList::longest + 1> place_{};
    std::array<char, model::RecentList::longest + 1> secret_file_{};
    std::array<char, 4097> secret_{};
    SecretBy secret_by_ = SecretBy::typing;
    std::optional<model::Place> read_;  // what is typed, where it can be read
    std::string fault_, advice_;
};

// What places are read by now, here.
model::Here here();

}  // namespace shearwater::ui
