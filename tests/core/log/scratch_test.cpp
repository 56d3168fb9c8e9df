// SPDX-License-Identifier: MIT
#include "core/log/scratch.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <set>
#include <vector>

namespace posewire::log {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

struct Block {
    std::array<std::uint64_t, 512> numbers;
};

std::shared_ptr<Block> filled(Scratch& scratch, std::uint64_t number) {
    auto block = scratch.make<Block>();
    block->numbers.fill(number);
    return block;
}

bool holds(const Block& block, std::uint64_t number) {
    return block.numbers.front() == number && block.numbers.back() == number;
}

/// In a folder whose file system has files without names; elsewhere there is nothing to be tested.
class ScratchTest : public testing::Test {
protected:
    void SetUp() override {
        if (!m_scratch->hasFile()) {
            GTEST_SKIP() << m_folder << " takes no file without a name";
        }
    }

    std::string m_folder = std::filesystem::temp_directory_path().string();
    std::shared_ptr<Scratch> m_scratch = std::make_shared<Scratch>(m_folder, 64 * kMiB);
};

TEST_F(ScratchTest, KeepsWhatWasWrittenWhileMoreIsTaken) {
    std::vector<std::shared_ptr<Block>> blocks;
    for (std::uint64_t i = 0; i < 10'000; ++i) { // 40 MiB: three segments
        blocks.push_back(filled(*m_scratch, i));
    }
    EXPECT_EQ(m_scratch->figures().fileBytes, 3 * Scratch::kSegment);
    EXPECT_EQ(m_scratch->figures().heapBytes, 0U);
    for (std::uint64_t i = 0; i < blocks.size(); ++i) {
        ASSERT_TRUE(holds(*blocks[i], i)) << i;
    }
}

TEST_F(ScratchTest, TakesAgainWhatWasGivenBack) {
    for (std::uint64_t i = 0; i < 100'000; ++i) {
        EXPECT_TRUE(holds(*filled(*m_scratch, i), i));
    }
    EXPECT_EQ(m_scratch->figures().fileBytes, Scratch::kSegment);
}

TEST_F(ScratchTest, GoesOnInMemoryWhereTheFileMayGrowNoMore) {
    std::vector<std::shared_ptr<Block>> blocks;
    for (std::uint64_t i = 0; i < 20'000; ++i) { // 80 MiB
        blocks.push_back(filled(*m_scratch, i));
    }
    EXPECT_FALSE(m_scratch->hasFile());
    EXPECT_EQ(m_scratch->figures().fileBytes, 64 * kMiB);
    EXPECT_GE(m_scratch->figures().heapBytes, 14 * kMiB);
    for (std::uint64_t i = 0; i < blocks.size(); ++i) {
        ASSERT_TRUE(holds(*blocks[i], i)) << i;
    }
    blocks.clear();
    EXPECT_EQ(m_scratch->figures().heapBytes, 0U);
}

TEST_F(ScratchTest, IsOutlivedByWhatWasTaken) {
    const auto block = filled(*m_scratch, 7);
    m_scratch.reset();
    EXPECT_TRUE(holds(*block, 7));
}

TEST_F(ScratchTest, LeavesNothingInItsFolder) {
    const auto names = [this] {
        std::set<std::string> all;
        for (const auto& entry : std::filesystem::directory_iterator(m_folder)) {
            all.insert(entry.path().string());
        }
        return all;
    };
    const std::filesystem::path own = std::filesystem::path(m_folder) / "posewire_scratch_test";
    std::filesystem::create_directory(own);
    m_folder = own.string();
    {
        const auto scratch = std::make_shared<Scratch>(m_folder, 64 * kMiB);
        const auto block = filled(*scratch, 1);
#ifndef _WIN32 // where it has a name as long as it is open
        EXPECT_TRUE(names().empty());
#endif
    }
    EXPECT_TRUE(names().empty());
    std::filesystem::remove(own);
}

TEST(ScratchWithoutFile, IsOrdinaryMemory) {
    for (const auto& scratch : {std::make_shared<Scratch>(), std::make_shared<Scratch>("/nowhere", kMiB)}) {
        EXPECT_FALSE(scratch->hasFile());
        const auto bytes = scratch->bytes(100);
        std::memset(bytes.get(), 1, 100);
        EXPECT_EQ(scratch->figures().heapBytes, 100U);
        EXPECT_EQ(scratch->figures().fileBytes, 0U);
    }
}

} // namespace
} // namespace posewire::log
