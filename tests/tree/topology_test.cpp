#include "common/tree/topology.h"

#include <gtest/gtest.h>

namespace shearwater::tree {
namespace {

constexpr std::string_view uneven = R"(
[[node]]
name = "left"
role = "renderer"
parent = "middle"
weight = 3.0
[[node]]
name = "middle"
role = "compositor"
[[node]]
name = "right"
role = "renderer"
parent = "middle"
host = "node7"
[[node]]
name = "alone"
role = "renderer"
[server]
listen = "0.0.0.0:7700"
[security]
secret_file = "/etc/tree.secret"
[placement]
launcher = "manual"
)";

TEST(Topology, ReadsAnUnevenTreeInAnyOrder) {
    const auto topology = topology_from_toml(uneven, "t.toml");
    ASSERT_TRUE(topology) << topology.error().message();
    ASSERT_EQ(topology->nodes.size(), 5U);
    EXPECT_EQ(topology->nodes[0].role, Role::server);
    EXPECT_EQ(topology->nodes[1].name, "middle");
    EXPECT_EQ(topology->nodes[1].weight, 4.0);  // what its children weigh
    EXPECT_EQ(topology->nodes[2].name, "alone");
    EXPECT_EQ(topology->nodes[3].name, "left");
    EXPECT_EQ(topology->nodes[3].parent, 1);
    EXPECT_EQ(topology->nodes[4].host, "node7");
    EXPECT_EQ(topology->listen, "0.0.0.0:7700");
    EXPECT_EQ(topology->launcher, Launcher::manual);
    EXPECT_EQ(topology->secret_file, "/etc/tree.secret");
}

TEST(Topology, ReadsAFullTree) {
    const auto topology = topology_from_toml("[tree]\nbranching = 3\nlevels = 3\n", "t.toml");
    ASSERT_TRUE(topology);
    EXPECT_EQ(topology->renderers(), 9);
    EXPECT_EQ(topology->launcher, Launcher::local);
}

void expect_refused(std::string_view text, std::string_view because,
                    base::Code code = base::Code::invalid_argument) {
    const auto topology = topology_from_toml(text, "t.toml");
    ASSERT_FALSE(topology) << text;
    EXPECT_EQ(topology.error().code, code);
    EXPECT_NE(topology.error().message().find(because), std::string::npos) << topology.error().message();
    EXPECT_EQ(topology.error().message().find('\n'), std::string::npos);
}

TEST(Topology, SaysWhatIsWrong) {
    expect_refused("", "neither [tree] nor [[node]]");
    expect_refused("[tree", "line 1", base::Code::corrupt);
    expect_refused("[tree]\nbranching = 65\nlevels = 2\n", "branching");
    expect_refused("[tree]\nbranching = 2\nlevels = 2\n[[node]]\nname = 'a'\nrole = 'renderer'\n",
                   "not both");
    expect_refused("[[node]]\nrole = 'renderer'\n", "name");
    expect_refused("[[node]]\nname = 'a'\nrole = 'juggler'\n", "role");
    expect_refused("[[node]]\nname = 'a'\nrole = 'renderer'\nwieght = 2\n", "wieght");
    expect_refused("[[node]]\nname = 'a'\nrole = 'renderer'\nweight = -1.0\n", "weight");
    expect_refused("[[node]]\nname = 'a'\nrole = 'renderer'\nweight = nan\n", "weight");
    expect_refused("[[node]]\nname = 'a'\nrole = 'renderer'\n[[node]]\nname = 'a'\nrole = 'renderer'\n",
                   "two nodes");
    expect_refused(
        "[[node]]\nname = 'a'\nrole = 'renderer'\n[[node]]\nname = 'b'\nrole = 'renderer'\nparent = 'a'\n",
        "hangs on a renderer");
    expect_refused(
        "[[node]]\nname = 'a'\nrole = 'compositor'\nparent = 'b'\n"
        "[[node]]\nname = 'b'\nrole = 'compositor'\nparent = 'a'\n",
        "does not lead to the server");
    expect_refused("[[node]]\nname = 'a'\nrole = 'compositor'\n", "no children");
    expect_refused("[[node]]\nname = 's'\nrole = 'server'\n[[node]]\nname = 't'\nrole = 'server'\n",
                   "more than one");
    expect_refused("[tree]\nbranching = 2\nlevels = 2\n[placement]\nlauncher = 'rocket'\n", "rocket");
    expect_refused("[tree]\nbranching = 2\nlevels = 2\n[sever]\nlisten = 'x'\n", "sever");
    expect_refused("[tree]\nbranching = 4294967298\nlevels = 2\n", "branching");
    expect_refused("[tree]\nbranching = 2\nlevels = 2\n[server]\nlisen = 'x'\n", "lisen");
    expect_refused("server = 3\n[tree]\nbranching = 2\nlevels = 2\n", "[server] is a table");
    std::string many;
    for (int i = 0; i < 65; ++i) {
        many += "[[node]]\nname = 'r" + std::to_string(i) + "'\nrole = 'renderer'\n";
    }
    expect_refused(many, "more than 64 children");
}

}  // namespace
}  // namespace shearwater::tree
