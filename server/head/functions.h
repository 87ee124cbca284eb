#pragma once
// Which opacity functions are wanted for what clients look at, and which renderers have told theirs.

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "common/culling/function_store.h"
#include "protocol/wire/convert_culling.h"
#include "protocol/wire/events.h"

namespace shearwater::head {

class Functions {
  public:
    // What is kept; the longest unused go first.
    static constexpr std::size_t most_keys = 24;
    // Before what renderers do not send is asked for once more.
    static constexpr std::chrono::seconds patience{120};
    // A pin that is being dragged changes its shape all the time: nothing is asked for until it has rested so
    // long.
    static constexpr std::chrono::milliseconds rest{150};

    // Of the places of so many renderers.
    explicit Functions(std::size_t renderers) : renderers_(renderers) {}

    // What a client's view by a kind of functions on a level goes by. As long as its pins keep their shapes,
    // what it needed on other levels is still wanted.
    struct Needed {
        bool any = false;                         // there is something of it
        bool all = false;                         // there is all of it
        std::vector<std::uint64_t> numbers = {};  // of the functions
    };
    Needed need(wire::LinkId client, const view::TransferFunction& tf, culling::Kind kind, int level);
    void forget(wire::LinkId client);
    // Values are mapped anew: none of the functions hold any more.
    void drop_all();

    // What renderers are to be told, if that has changed since this last gave it, and has rested.
    std::optional<wire::Message> take_wanted(wire::Time now);
    // What is not kept any longer since this was last asked.
    std::vector<culling::FunctionKey> take_dropped() { return std::exchange(dropped_, {}); }

    // The key that a number is of, if that is kept.
    std::optional<culling::FunctionKey> key_of(std::uint64_t number) const;
    // Something has come; the key that it is of, if that is kept.
    std::optional<culling::FunctionKey> came(const wire::FunctionPart& part, wire::Time now);

  private:
    struct Entry {
        culling::FunctionKey key;
        std::uint64_t number;
        std::uint64_t used;
        bool any = false;               // some renderer has told something
        std::map<int, int> directions;  // of the fine ones, by place
    };
    struct Need {
        std::vector<culling::Basis> bases;
        culling::Kind kind;
        std::vector<std::uint64_t> numbers;
    };

    Entry& entry(const culling::FunctionKey& key);
    bool wanted(std::uint64_t number) const;
    bool all_known(const Entry& entry) const;

    std::size_t renderers_;
    std::vector<Entry> entries_;
    std::map<wire::LinkId, Need> needs_;
    std::vector<culling::FunctionKey> dropped_;
    std::uint64_t last_number_ = 0, clock_ = 0, renewal_ = 1;
    bool news_ = false;   // to be told
    bool fresh_ = false;  // since take_wanted() was last asked
    wire::Time changed_{}, heard_{};
};

}  // namespace shearwater::head
