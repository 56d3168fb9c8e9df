// SPDX-License-Identifier: MIT
#include "core/export/json.h"
#include "core/wire/codec.h"
#include "tests/support/golden.h"

#include <gtest/gtest.h>

#include <random>

namespace posewire::exporting {
namespace {

void expectGivenBack(const std::vector<std::byte>& bytes, const std::string& name) {
    const std::string line = datagramJson({}, bytes);
    EXPECT_EQ(line.find('\n'), std::string::npos) << name;
    const auto again = datagramFromJson(line);
    if (wire::decode(bytes)) {
        ASSERT_TRUE(again) << name << ": " << again.error().text << "\n" << line;
        EXPECT_EQ(*again, bytes) << name << "\n" << line;
    } else {
        ASSERT_FALSE(again) << name;
        EXPECT_EQ(again.error().kind, JsonFault::Kind::NotDatagram) << name;
    }
}

TEST(JsonRoundTrip, GivesBackEveryGoldenBitForBit) {
    for (const auto& golden : posewire::test::goldens()) {
        expectGivenBack(golden.bytes, golden.name);
    }
}

TEST(JsonRoundTrip, GivesBackTheRecordedDatagramsBitForBit) {
    if (posewire::test::capture("mxtp02.bin").empty()) {
        GTEST_SKIP() << "NOT TESTED: the recorded datagrams are not at hand";
    }
    for (const char* file : {"mxtp01.bin", "mxtp02.bin", "mxtp12.bin", "mxtp13.bin"}) {
        expectGivenBack(posewire::test::capture(file), file);
    }
}

TEST(JsonRoundTrip, GivesBackEveryCutThatCanBeRead) {
    for (const auto& golden : posewire::test::goldens()) {
        for (std::size_t length = 0; length<golden.bytes.size(); length += golden.bytes.size()> 300 ? 7 : 1) {
            expectGivenBack(
                {golden.bytes.begin(), golden.bytes.begin() + static_cast<std::ptrdiff_t>(length)},
                golden.name);
        }
    }
}

TEST(JsonRoundTrip, GivesBackThousandsOfDamagedDatagrams) {
    std::mt19937 random(20261121);
    const auto& goldens = posewire::test::goldens();
    int readable = 0;
    for (int round = 0; round < 10000; ++round) {
        auto [name, bytes] = goldens[random() % goldens.size()];
        for (std::size_t changes = 1 + random() % 4; changes > 0; --changes) {
            bytes[random() % 3 == 0 ? 6 + random() % 18 : 6 + random() % (bytes.size() - 6)] =
                static_cast<std::byte>(random());
        }
        if (random() % 4 == 0) {
            bytes.resize(bytes.size() + random() % 20, static_cast<std::byte>(random()));
        }
        readable += wire::decode(bytes) ? 1 : 0;
        expectGivenBack(bytes, name);
    }
    EXPECT_GT(readable, 2000);
}

} // namespace
} // namespace posewire::exporting
