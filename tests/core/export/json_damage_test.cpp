// SPDX-License-Identifier: MIT
#include "core/export/json.h"
#include "core/wire/codec.h"
#include "tests/support/golden.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <functional>

// Objects as people and scripts change them: keys that are gone, renamed, out of order, of another kind.
namespace posewire::exporting {
namespace {

using OrderedJson = nlohmann::ordered_json;
using Pointer = OrderedJson::json_pointer;

/// Each place in an object at which a value stands, lists cut to their first two members.
void visit(const OrderedJson& value, const Pointer& at, const std::function<void(const Pointer&)>& take) {
    if (!at.empty()) {
        take(at);
    }
    if (value.is_object()) {
        for (const auto& [key, member] : value.items()) {
            visit(member, at / key, take);
        }
    } else if (value.is_array()) {
        for (std::size_t i = 0; i < std::min<std::size_t>(value.size(), 2); ++i) {
            visit(value[i], at / i, take);
        }
    }
}

struct EveryLine : testing::TestWithParam<std::string> {
    OrderedJson object() const { return OrderedJson::parse(datagramJson({}, bytes)); }
    std::vector<std::byte> bytes = posewire::test::golden(GetParam()).bytes;
};

TEST_P(EveryLine, SaysNothingElseWhenItsKeysAreSorted) {
    if (object().contains("bytes")) {
        GTEST_SKIP() << "the bytes win";
    }
    const nlohmann::json sorted = nlohmann::json::parse(datagramJson({}, bytes));
    const auto again = datagramFromJson(sorted.dump());
    ASSERT_TRUE(again) << again.error().text;
    EXPECT_EQ(*again, bytes);
}

TEST_P(EveryLine, SaysNothingElseWithSpacesAndUnknownKeys) {
    OrderedJson more = object();
    more["comment"] = "from take 7";
    more["body"]["note"] = OrderedJson::array({1, OrderedJson::object({{"x", nullptr}})});
    const auto again = datagramFromJson(more.dump(3, '\t').append("  \n"));
    ASSERT_TRUE(again) << again.error().text;
    EXPECT_EQ(*again, bytes);
}

TEST_P(EveryLine, NamesWhatHasAnotherKind) {
    const OrderedJson whole = object();
    if (whole.contains("bytes")) {
        GTEST_SKIP() << "the bytes win";
    }
    std::size_t refused = 0;
    visit(whole, Pointer(), [&](const Pointer& at) {
        for (const OrderedJson& other :
             {OrderedJson(true), OrderedJson(-7.5), OrderedJson("x"), OrderedJson::array({}),
              OrderedJson::object(), OrderedJson(nullptr)}) {
            OrderedJson changed = whole;
            changed[at] = other;
            const auto result = datagramFromJson(changed.dump());
            if (result) {
                EXPECT_GE(result->size(), wire::kHeaderSize) << changed;
                continue;
            }
            ++refused;
            const std::string& text = result.error().text;
            EXPECT_NE(text.find(": "), std::string::npos) << text;
            EXPECT_EQ(text.find('\n'), std::string::npos) << text;
            const std::string first = at.to_string().substr(1, at.to_string().find('/', 1) - 1);
            EXPECT_TRUE(text.starts_with(first)) << at << " is " << other << ": " << text;
        }
    });
    EXPECT_GT(refused, 10U);
}

TEST_P(EveryLine, NamesWhatIsMissingFromItsBody) {
    const OrderedJson whole = object();
    if (whole.contains("bytes")) {
        GTEST_SKIP() << "the bytes win";
    }
    visit(whole["body"], Pointer("/body"), [&](const Pointer& at) {
        OrderedJson changed = whole;
        if (!changed[at.parent_pointer()].is_object()) {
            return;
        }
        changed[at.parent_pointer()].erase(at.back());
        const auto result = datagramFromJson(changed.dump());
        if (!result) {
            EXPECT_EQ(result.error().kind, JsonFault::Kind::BadField);
            EXPECT_TRUE(result.error().text.starts_with("body")) << result.error().text;
        } else {
            EXPECT_NE(*result, bytes) << at << " can be left out and does not matter";
        }
    });
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

INSTANTIATE_TEST_SUITE_P(, EveryLine, testing::ValuesIn(readableGoldens()),
                         [](const auto& instance) { return instance.param; });

} // namespace
} // namespace posewire::exporting
