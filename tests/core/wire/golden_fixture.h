// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/codec.h"
#include "tests/support/golden.h"

#include <gtest/gtest.h>

namespace posewire::wire::test {

/// One test a golden.
class GoldenTest : public testing::TestWithParam<std::string> {
protected:
    [[nodiscard]] const std::string& name() const { return GetParam(); }
    [[nodiscard]] bool isNamed(std::initializer_list<std::string_view> names) const {
        return std::find(names.begin(), names.end(), name()) != names.end();
    }
    [[nodiscard]] const std::vector<std::byte>& bytes() const { return posewire::test::golden(name()).bytes; }
    [[nodiscard]] Bytes first(std::size_t count) const { return Bytes(bytes()).first(count); }
};

inline std::vector<std::string> goldenNames() {
    std::vector<std::string> names;
    for (const auto& golden : posewire::test::goldens()) {
        names.push_back(golden.name);
    }
    return names;
}

inline std::string goldenTestName(const testing::TestParamInfo<std::string>& info) {
    return info.param;
}

} // namespace posewire::wire::test
