// SPDX-License-Identifier: MIT
#include "tests/core/filter/filter_fixture.h"

#include "core/field/field.h"
#include "core/wire/field_tree.h"

#include <cmath>
#include <map>

// Every value of every message written down in tests/golden, as the inspector shows it, against filters.
namespace posewire::filter::test {
namespace {

struct EveryGolden : testing::TestWithParam<std::string> {
    Case packet = golden(GetParam());
    wire::FieldTree tree = wire::fieldTree(packet.bytes, wire::FieldDetail::Parts);

    /// The name by which filters know a number: "segments.position.x", without places in lists.
    [[nodiscard]] std::string nameOf(std::size_t node) const {
        std::string name;
        bool isWithin = false;
        for (const char character : tree.path(static_cast<std::int32_t>(node))) {
            isWithin = (isWithin || character == '[') && character != ']';
            if (!isWithin && character != ']') {
                name += character;
            }
        }
        return name;
    }

    [[nodiscard]] bool has(const std::string& name) const {
        for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
            if (nameOf(i) == name) {
                return true;
            }
        }
        return false;
    }

    /// All numbers of a name in the packet, where filters know the name.
    [[nodiscard]] std::map<std::string, std::vector<double>> numbers() const {
        std::map<std::string, std::vector<double>> all;
        for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
            const wire::FieldNode& node = tree.nodes[i];
            const bool isNumber = !std::isnan(node.number) &&
                                  (node.kind == wire::NodeKind::Field || node.kind == wire::NodeKind::Part);
            const std::string asSent = std::string(field::kAsSent) + nameOf(i);
            const std::string name = Filter::compile(asSent + " == 1") ? asSent : nameOf(i);
            if (isNumber && node.scalar != wire::Scalar::Text && Filter::compile(name + " == 1")) {
                all[name].push_back(node.number);
            }
        }
        return all;
    }
};

std::string digits(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", number);
    return text;
}

TEST_P(EveryGolden, ComparesItsNumbersAsOrderDemands) {
    const auto all = numbers();
    EXPECT_GT(all.size(), 4U);
    for (const auto& [name, values] : all) {
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        const std::string low = digits(*least);
        const std::string high = digits(*most);
        EXPECT_TRUE(matches(packet, name + " >= " + high)) << name;
        EXPECT_TRUE(matches(packet, name + " <= " + low)) << name;
        EXPECT_FALSE(matches(packet, name + " > " + high)) << name << ' ' << high;
        EXPECT_FALSE(matches(packet, name + " < " + low)) << name << ' ' << low;
        EXPECT_TRUE(matches(packet, name + " in " + low + ".." + high)) << name;
        EXPECT_TRUE(matches(packet, name + " in {" + high + ", " + low + "}")) << name;
        EXPECT_EQ(matches(packet, name + " != " + low), *least != *most) << name;
    }
}

TEST_P(EveryGolden, MeetsNoComparisonWithWhatItDoesNotHave) {
    std::size_t lacked = 0;
    for (const char* name :
         {"segments.position.x", "segments.rotation.y", "segments.orientation.w", "joints.parent",
          "points.position.z", "trackers.magneticField.x", "segments.velocity.z", "segments.matrix.9",
          "props.id", "segments.angularVelocity.y", "joints.rotation.z"}) {
        const std::string field = name;
        if (has(field) || has(field.substr(0, field.rfind('.')))) {
            continue;
        }
        ++lacked;
        EXPECT_FALSE(matches(packet, field)) << name;
        for (const char* comparison :
             {" == 0", " != 0", " < 1e30", " >= -1e30", " in -1e30..1e30", " in {0, 1}"}) {
            EXPECT_FALSE(matches(packet, field + comparison)) << name << comparison;
            EXPECT_TRUE(matches(packet, "!(" + field + comparison + ")")) << name << comparison;
        }
    }
    EXPECT_GT(lacked, 4U);
}

std::vector<std::string> readableGoldens() {
    std::vector<std::string> names;
    for (const auto& golden : posewire::test::goldens()) {
        if (wire::decode(golden.bytes)) {
            names.push_back(golden.name);
        }
    }
    return names;
}

INSTANTIATE_TEST_SUITE_P(, EveryGolden, testing::ValuesIn(readableGoldens()),
                         [](const auto& instance) { return instance.param; });

} // namespace
} // namespace posewire::filter::test
