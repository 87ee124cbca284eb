#include "client/view/likeness.h"

#include <imgui.h>

#include <boost/container_hash/hash.hpp>
#include <functional>
#include <string_view>

namespace shearwater::ui {

namespace {

// Vertices, indices and commands have no bytes that nobody writes.
template <class Item>
void add(std::size_t& sum, const ImVector<Item>& items) {
    const std::string_view bytes(reinterpret_cast<const char*>(items.Data),
                                 static_cast<std::size_t>(items.size_in_bytes()));
    boost::hash_combine(sum, std::hash<std::string_view>()(bytes));
}

}  // namespace

std::uint64_t likeness(const ImDrawData& pass) {
    std::size_t sum = 0;
    for (const float of : {pass.DisplayPos.x, pass.DisplayPos.y, pass.DisplaySize.x, pass.DisplaySize.y,
                           pass.FramebufferScale.x, pass.FramebufferScale.y}) {
        boost::hash_combine(sum, of);
    }
    for (int n = 0; n < pass.CmdListsCount; ++n) {
        const ImDrawList& list = *pass.CmdLists[n];
        add(sum, list.VtxBuffer);
        add(sum, list.IdxBuffer);
        add(sum, list.CmdBuffer);
    }
    return sum;
}

}  // namespace shearwater::ui
