// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/stage/spool.h"

#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace posewire::stage {
namespace {

class SpoolTest : public testing::Test {
protected:
    void append(int from, int to) {
        const log::SenderId sender = m_log.senders().intern({"10.0.0.7:40001", log::Transport::Udp, 9763});
        for (int i = from; i < to; ++i) {
            const std::string text = textOf(i);
            m_log.writer().append(std::as_bytes(std::span(text)), {.stamp = stampOf(i), .sender = sender});
        }
        m_log.writer().publish();
    }
    static std::string textOf(int i) { return "MXTP" + std::to_string(i % 3); } // some are alike
    static log::Stamp stampOf(int i) { return log::stampOf(1'700'000'000'000'000'000 + i * 1'000); }
    static void noteStored(Spool& spool, int i) {
        const std::string text = textOf(i);
        spool.noteStored(log::asWallTime(stampOf(i)), std::as_bytes(std::span(text)));
    }
    [[nodiscard]] std::vector<std::int64_t> left() const {
        std::vector<std::int64_t> numbers;
        Spool(m_folder, kMost).readLeft([&](const log::FileRecord& record) {
            numbers.push_back((log::asStamp(*record.time) - stampOf(0)).count() / 1'000);
        });
        return numbers;
    }

    static constexpr std::uint64_t kMost = 16 << 20;
    const std::string m_folder = (test::newTemporaryFolder("spool") / "spool").string();
    log::PacketLog m_log;
};

TEST_F(SpoolTest, LeavesTheNextProbeWhatWasNotStored) {
    append(0, 10);
    Spool spool(m_folder, kMost);
    ASSERT_EQ(spool.begin(m_log), std::nullopt);
    noteStored(spool, 3);
    append(10, 12);
    spool.leave();
    EXPECT_EQ(left(), (std::vector<std::int64_t>{4, 5, 6, 7, 8, 9, 10, 11}));
    Spool(m_folder, kMost).dropLeft();
    EXPECT_TRUE(left().empty());
}

TEST_F(SpoolTest, LeavesAllWhereNothingOfItWasStored) {
    append(0, 3);
    Spool spool(m_folder, kMost);
    ASSERT_EQ(spool.begin(m_log), std::nullopt);
    noteStored(spool, -1); // one that is in no file any more
    spool.leave();
    EXPECT_EQ(left(), (std::vector<std::int64_t>{0, 1, 2}));
}

TEST_F(SpoolTest, LeavesNothingOnceAllIsStored) {
    append(0, 3);
    Spool spool(m_folder, kMost);
    ASSERT_EQ(spool.begin(m_log), std::nullopt);
    spool.drop();
    EXPECT_TRUE(left().empty());
}

TEST_F(SpoolTest, SaysWhereItCannotWrite) {
    Spool spool("/dev/null/spool", kMost);
    const auto problem = spool.begin(m_log);
    ASSERT_TRUE(problem.has_value());
    EXPECT_NE(problem->text.find("/dev/null/spool"), std::string::npos);
}

} // namespace
} // namespace posewire::stage
