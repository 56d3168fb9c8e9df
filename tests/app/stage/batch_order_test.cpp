// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/stage/batch_order.h"

#include "app/stage/batch.h"

#include <nats/nats.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace posewire::stage {
namespace {

/// What a batch brought.
struct Brought {
    std::vector<std::string> bytes;
    std::vector<std::uint32_t> lostOnWay; ///< before one of these
    BatchOrder::Taken taken;
};

class BatchOrderTest : public testing::Test {
protected:
    static void SetUpTestSuite() { nats_Open(-1); }

    struct Sent {
        std::string run = "0123456789abcdef";
        std::uint64_t first = 0;
        std::vector<std::string> packets{"one", "two", "three"};
        std::string subject = "posewire.SITE.STAGE-A.batch";
        std::string layout = "1";
        std::size_t cut = 0; ///< bytes at the end of it
        std::int64_t time = 1'000;
    };

    Brought take(const Sent& sent) {
        Batch batch;
        std::uint64_t number = sent.first;
        std::int64_t time = sent.time;
        for (const std::string& text : sent.packets) {
            batch.add({number++,
                       log::stampOf(time++),
                       {},
                       0,
                       {.stampedByKernel = true},
                       std::as_bytes(std::span(text))},
                      {"10.0.0.7:40001", log::Transport::Udp, 9763});
        }
        natsMsg* made = nullptr;
        natsMsg_Create(&made, sent.subject.c_str(), nullptr,
                       reinterpret_cast<const char*>(batch.bytes().data()),
                       static_cast<int>(batch.bytes().size() - sent.cut));
        natsMsgHeader_Set(made, kLayoutHeader, sent.layout.c_str());
        natsMsgHeader_Set(made, kRunHeader, sent.run.c_str());
        natsMsgHeader_Set(made, kFirstHeader, std::to_string(sent.first).c_str());
        natsMsgHeader_Set(made, kCountHeader, std::to_string(sent.packets.size()).c_str());
        const Message message(made);
        Brought brought;
        brought.taken = m_order.take(message, [&](const log::FileRecord& record) {
            EXPECT_EQ(record.sender,
                      (log::SenderInfo{"10.0.0.7:40001", log::Transport::Udp, 9763, "STAGE-A"}));
            if (record.flags.isLostOnWay) {
                brought.lostOnWay.push_back(record.kernelDropsBefore);
            } else {
                brought.bytes.emplace_back(reinterpret_cast<const char*>(record.bytes.data()),
                                           record.bytes.size());
            }
        });
        return brought;
    }

    BatchOrder m_order;
};

TEST_F(BatchOrderTest, BringsEachPacketOnceWithItsProbe) {
    const Brought first = take({});
    EXPECT_EQ(first.bytes, (std::vector<std::string>{"one", "two", "three"}));
    EXPECT_EQ(first.taken.probe, "STAGE-A");
    EXPECT_TRUE(take({}).bytes.empty()) << "it came before";
    EXPECT_EQ(take({.first = 3}).bytes.size(), 3U);
}

TEST_F(BatchOrderTest, CountsWhatDidNotCome) {
    take({});
    const Brought later = take({.first = 10});
    EXPECT_EQ(later.lostOnWay, std::vector<std::uint32_t>{7});
    EXPECT_EQ(later.taken.lostOnWay, 7U);
    EXPECT_EQ(later.bytes.size(), 3U);
    EXPECT_TRUE(take({.first = 13}).lostOnWay.empty());
}

TEST_F(BatchOrderTest, LeavesOutWhatANewRunRepeats) {
    take({});
    const Brought again =
        take({.run = "fedcba9876543210", .packets = {"two", "three", "two", "four"}, .time = 1'001});
    EXPECT_EQ(again.bytes, (std::vector<std::string>{"two", "four"}));
    EXPECT_EQ(again.taken.packets, 2U);
}

TEST_F(BatchOrderTest, LeavesOutRepeatsInSmallerBatchesToo) {
    take({});
    const std::string run = "fedcba9876543210";
    EXPECT_TRUE(take({.run = run, .packets = {"one", "two"}}).bytes.empty());
    EXPECT_EQ(take({.run = run, .first = 2, .packets = {"three", "four"}, .time = 1'002}).bytes,
              std::vector<std::string>{"four"});
    EXPECT_EQ(take({.run = run, .first = 4, .packets = {"one"}}).bytes.size(), 1U) << "what is new is new";
}

TEST_F(BatchOrderTest, MissesNothingWhereAProbeBeginsAgain) {
    take({.first = 100});
    const Brought again = take({.run = "fedcba9876543210", .time = 2'000});
    EXPECT_EQ(again.bytes.size(), 3U);
    EXPECT_TRUE(again.lostOnWay.empty());
    EXPECT_TRUE(again.taken.problem.empty());
}

TEST_F(BatchOrderTest, FindsTwoProbesOfOneName) {
    take({});
    take({.run = "fedcba9876543210", .time = 2'000});
    EXPECT_FALSE(take({.first = 3}).taken.problem.empty());
}

TEST_F(BatchOrderTest, LeavesAloneWhatItDoesNotKnow) {
    EXPECT_FALSE(take({.layout = "2"}).taken.problem.empty());
    EXPECT_FALSE(take({.layout = "one"}).taken.problem.empty());
    EXPECT_TRUE(take({.subject = "posewire"}).taken.probe.empty());
    EXPECT_TRUE(take({.subject = "posewire.SITE.a b.batch"}).bytes.empty());
    EXPECT_EQ(take({}).bytes.size(), 3U) << "and goes on";
}

TEST_F(BatchOrderTest, BringsWhatComesBeforeTheDamage) {
    const Brought cut = take({.cut = 30});
    EXPECT_EQ(cut.bytes, (std::vector<std::string>{"one", "two"}));
    EXPECT_FALSE(cut.taken.problem.empty());
}

} // namespace
} // namespace posewire::stage
