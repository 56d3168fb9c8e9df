// SPDX-License-Identifier: MIT
#include "core/log/disk_history.h"

#include "core/log/recording_file.h"
#include "core/log/system_files.h"
#include "tests/core/log/log_fixture.h"
#include "tests/support/stream_source.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>

namespace posewire::log {
namespace {

namespace fs = std::filesystem;

/// A log that is much smaller than what goes through it, and files that are followed in step with it.
class DiskHistoryTest : public testing::Test {
protected:
    static constexpr std::uint64_t kMost = std::uint64_t{16} << 20;

    void SetUp() override {
        m_folder = fs::temp_directory_path() /
                   ("posewire_history_" +
                    std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        fs::create_directory(m_folder);
    }
    void TearDown() override { fs::remove_all(m_folder); }

    static std::unique_ptr<DiskHistory> start(PacketLog& log, const std::string& folder) {
        auto history = DiskHistory::start(log, {folder, kMost, 0}, {});
        EXPECT_TRUE(history) << history.error().text;
        return history ? std::move(*history) : nullptr;
    }
    void append(std::size_t count) {
        for (; count > 0; --count, ++m_next) {
            m_log.writer().append(pattern(sizeOf(m_next), m_next),
                                  {.stamp = Stamp(Duration(1'000 * m_next)), .sender = m_sender});
        }
        m_log.writer().publish();
    }
    static std::size_t sizeOf(std::uint64_t number) { return 500 + number * 37 % 900; }
    /// In steps that memory can hold, until the files have them.
    void appendInStep(const DiskHistory& history, std::size_t count) {
        constexpr std::size_t step = 750;
        for (std::size_t i = 0; i < count; i += step) {
            append(step);
            ASSERT_TRUE(waitUntil([&] { return history.figures().end == m_next; }));
        }
    }
    static bool waitUntil(const std::function<bool()>& condition) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (!condition() && std::chrono::steady_clock::now() < end) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return condition();
    }
    [[nodiscard]] std::vector<fs::path> files() const {
        std::vector<fs::path> paths;
        for (const auto& entry : fs::directory_iterator(m_folder)) {
            paths.push_back(entry.path());
        }
        return paths;
    }

    fs::path m_folder;
    PacketLog m_log{kSmallLog};
    SenderId m_sender = m_log.senders().intern({"10.0.0.1:5", Transport::Udp, 9763});
    std::uint64_t m_next = 0;
};

TEST_F(DiskHistoryTest, WhatMemoryDropsIsReadFromTheFiles) {
    const auto history = start(m_log, m_folder.string());
    ASSERT_NE(history, nullptr);
    appendInStep(*history, 12'000);
    EXPECT_GT(m_log.figures().begin, 9'000U);
    LogReader reader(m_log);
    EXPECT_EQ(reader.begin(), 0U);
    for (std::uint64_t number = 0; number < m_next; ++number) {
        const auto packet = reader.packet(number);
        ASSERT_TRUE(packet && equal(packet->bytes, pattern(sizeOf(number), number))) << number;
        ASSERT_EQ(packet->stamp, Stamp(Duration(1'000 * number)));
        ASSERT_EQ(packet->sender, m_sender);
    }
    EXPECT_EQ(history->figures().missed, 0U);
    EXPECT_FALSE(history->failure());
}

TEST_F(DiskHistoryTest, TheOldestFileGoesAtTheCap) {
    const auto history = start(m_log, m_folder.string());
    ASSERT_NE(history, nullptr);
    appendInStep(*history, 25'000); // about 25 MB
    EXPECT_LE(history->figures().bytes, kMost + (kMost >> 4));
    EXPECT_GT(history->figures().bytes, kMost / 2);
    EXPECT_EQ(files().size(), DiskHistory::kFiles);
    LogReader reader(m_log);
    EXPECT_EQ(reader.begin(), history->figures().begin);
    EXPECT_GT(reader.begin(), 5'000U);
    EXPECT_TRUE(reader.packet(reader.begin()));
    EXPECT_TRUE(reader.packet(m_next - 1));
}

TEST_F(DiskHistoryTest, LeavesNoFileAndTheLogItsMemory) {
    auto history = start(m_log, m_folder.string());
    ASSERT_NE(history, nullptr);
    appendInStep(*history, 6'000);
    history.reset();
    EXPECT_TRUE(files().empty());
    const LogReader reader(m_log);
    EXPECT_EQ(reader.begin(), m_log.figures().begin);
}

TEST_F(DiskHistoryTest, ItsFilesAreRecordingsThatSurviveTheProcess) {
    const auto history = start(m_log, m_folder.string());
    ASSERT_NE(history, nullptr);
    append(900);
    ASSERT_TRUE(waitUntil([&] { return history->figures().end == m_next; }));
    ASSERT_EQ(files().size(), 1U);
    std::ifstream stream(files().front(), std::ios::binary);
    const auto source = test::readingFrom(stream, "history");
    std::uint64_t read = 0;
    const auto result = readFile(*source, [&](const FileRecord& record) {
        EXPECT_TRUE(equal(record.bytes, pattern(sizeOf(read), read)));
        ++read;
    });
    EXPECT_TRUE(result) << result.error().text;
    EXPECT_EQ(read, m_next);
    EXPECT_EQ(beginOf(files().front().string()), WallTime(Duration(0)));
    EXPECT_FALSE(beginOf((m_folder / "none").string()));
}

/// Whatever number its process has: another process may have it by now, and containers number their own.
TEST_F(DiskHistoryTest, FilesThatNobodyUsesAreFoundAndNoOthers) {
    const std::string own = "history-" + std::to_string(processNumber()) + "-";
    for (const std::string& name : {own + "1.pcapng", own + "2.pcapng"}) {
        std::ofstream(m_folder / name) << "x";
    }
    std::ofstream(m_folder / "take.pcapng") << "x";
    std::ofstream(m_folder / "history-1-1.pcapng").flush(); // may be about to be used
    fs::last_write_time(m_folder / (own + "2.pcapng"),
                        fs::file_time_type::clock::now() - std::chrono::hours(1));
    const auto history = start(m_log, m_folder.string());
    ASSERT_NE(history, nullptr);
    appendInStep(*history, 750);
    EXPECT_TRUE(fs::exists(m_folder / (own + "3.pcapng"))) << "a name of its own";
    const std::vector<LostHistory> lost = lostHistories(m_folder.string());
    ASSERT_EQ(lost.size(), 2U);
    EXPECT_EQ(lost[0].path, m_folder / (own + "2.pcapng")) << "the oldest first";
    EXPECT_EQ(lost[1].path, m_folder / (own + "1.pcapng"));
    EXPECT_TRUE(lostHistories((m_folder / "none").string()).empty());
}

TEST_F(DiskHistoryTest, OfDeadProcessesTheNewestFilesStay) {
    const auto now = fs::file_time_type::clock::now();
    for (int i = 1; i <= 3; ++i) {
        const fs::path file = m_folder / ("history-999999999-" + std::to_string(i) + ".pcapng");
        std::ofstream(file) << std::string(1'000, 'x');
        fs::last_write_time(file, now - std::chrono::hours(3 - i));
    }
    const auto empty = [&](const char* name, std::chrono::minutes age) {
        std::ofstream(m_folder / name).flush();
        fs::last_write_time(m_folder / name, now - age);
    };
    empty("history-1-1.pcapng", std::chrono::minutes(0));
    empty("history-1-2.pcapng", std::chrono::minutes(2));
    discardHistories(m_folder.string(), 2'500);
    EXPECT_TRUE(fs::exists(m_folder / "history-1-1.pcapng")) << "it may be about to be used";
    EXPECT_FALSE(fs::exists(m_folder / "history-1-2.pcapng"));
    fs::remove(m_folder / "history-1-1.pcapng");
    EXPECT_EQ(lostHistories(m_folder.string()).size(), 2U);
    EXPECT_FALSE(fs::exists(m_folder / "history-999999999-1.pcapng"));
    discardHistories(m_folder.string(), 0);
    EXPECT_TRUE(files().empty());
}

TEST_F(DiskHistoryTest, SaysWhereNoFileCanBeMade) {
    const auto history = DiskHistory::start(m_log, {(m_folder / "none").string(), kMost, 0}, {});
    ASSERT_FALSE(history);
    EXPECT_NE(history.error().text.find("none"), std::string::npos) << history.error().text;
}

/// A disk that has too little room gives up all but the newest file.
TEST_F(DiskHistoryTest, LeavesRoomOnTheDisk) {
    auto history = DiskHistory::start(m_log, {m_folder.string(), kMost, UINT64_MAX}, {});
    ASSERT_TRUE(history);
    appendInStep(**history, 9'000);
    EXPECT_LE(files().size(), 2U);
    EXPECT_FALSE((*history)->failure());
}

} // namespace
} // namespace posewire::log
