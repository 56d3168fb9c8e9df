// SPDX-License-Identifier: MIT
#include "core/log/pcapng_writer.h"
#include "core/log/recording.h"
#include "core/wire/text.h"
#include "tests/core/log/log_fixture.h"
#include "tests/core/log/recording_fixture.h"

#include <gtest/gtest.h>

#include <map>

namespace posewire::log {
namespace {

using namespace std::chrono_literals;

const SenderInfo kSender{"10.0.0.2:40001", Transport::Udp, 9763};

Packet packetOf(const ByteVector& bytes, std::uint32_t drops = 0) {
    return {0, Stamp(1s), {}, drops, {.stampedByKernel = true}, bytes};
}

class RecordingFaults : public testing::Test {
protected:
    void append(std::uint64_t count, std::uint32_t drops = 0) {
        const SenderId sender = m_log.senders().intern(kSender);
        for (; count > 0; --count) {
            m_log.writer().append(poseDatagram(m_next++),
                                  {Stamp(1s), sender, drops, {.stampedByKernel = true}});
        }
        m_log.writer().publish();
    }
    PacketLog m_log{kSmallLog};
    std::uint32_t m_next = 0;
};

/// Wherever the disk is full: the failure is reported by the call that meets it, and what was written opens.
TEST_F(RecordingFaults, LeaveAFileThatOpensWhereverTheDiskIsFull) {
    append(3);
    MemorySink whole;
    Recorder complete(m_log, whole);
    ASSERT_TRUE(complete.begin({}) && complete.finish());
    for (std::size_t room = 0; room < whole.bytes.size(); room += 4) {
        MemorySink sink(room);
        Recorder recorder(m_log, sink);
        auto result = recorder.begin({});
        if (result) {
            result = recorder.follow();
        }
        if (result) {
            result = recorder.finish();
        }
        ASSERT_FALSE(result) << room;
        EXPECT_EQ(result.error().text, "memory: the disk is full");
        EXPECT_LE(sink.bytes.size(), room);
        EXPECT_LE(recordedIn(sink.bytes).size(), 3U);
    }
}

TEST_F(RecordingFaults, CountWhatWasMissedAndWhatTheKernelDropped) {
    MemorySink sink;
    Recorder recorder(m_log, sink);
    ASSERT_TRUE(recorder.begin({}));
    append(1, 7);
    ASSERT_TRUE(recorder.follow());
    append(5000, 2);
    ASSERT_TRUE(recorder.follow());
    const std::uint64_t missed = recorder.figures().missed;
    ASSERT_GT(missed, 0U);
    append(1, 3);
    ASSERT_TRUE(recorder.finish());
    EXPECT_EQ(recorder.figures().missed, missed);
    const auto seen = recordedIn(sink.bytes);
    ASSERT_EQ(seen.size() + missed, 5002U);
    EXPECT_EQ(seen[0].kernelDropsBefore, 7U);
    EXPECT_EQ(seen[1].kernelDropsBefore, missed + 2 * missed + 2) << "those before each that was missed, too";
    EXPECT_EQ(seen[2].kernelDropsBefore, 2U);
    EXPECT_EQ(seen.back().kernelDropsBefore, 3U);
}

TEST_F(RecordingFaults, CountWhatIsMissedBetweenTwoFiles) {
    MemorySink first;
    Recorder before(m_log, first);
    append(3);
    ASSERT_TRUE(before.begin({}) && before.finish());
    append(5000);
    MemorySink second;
    Recorder after(m_log, second, before.follower());
    ASSERT_TRUE(after.begin({}) && after.finish());
    EXPECT_EQ(before.figures().missed, 0U);
    const std::uint64_t missed = after.figures().missed;
    ASSERT_GT(missed, 0U);
    const auto seen = recordedIn(second.bytes);
    ASSERT_EQ(seen.size() + missed, 5000U);
    EXPECT_EQ(seen[0].kernelDropsBefore, missed);
    EXPECT_EQ(after.placeOf(5002), seen.size() - 1);
    EXPECT_EQ(after.placeOf(4), 0U) << "which is missed";
}

TEST_F(RecordingFaults, DoNotLetTheCountOfDropsWrapAround) {
    MemorySink sink;
    Recorder recorder(m_log, sink);
    ASSERT_TRUE(recorder.begin({}));
    append(5000, 0xffffffff);
    ASSERT_TRUE(recorder.finish());
    ASSERT_GT(recorder.figures().missed, 0U);
    EXPECT_EQ(recordedIn(sink.bytes)[0].kernelDropsBefore, 0xffffffffU);
}

TEST_F(RecordingFaults, BeginWithTheOldestPacketWhereTheWantedOneIsGone) {
    append(5000);
    MemorySink sink;
    Recorder recorder(m_log, sink, 3);
    ASSERT_TRUE(recorder.begin({}) && recorder.finish());
    EXPECT_EQ(recorder.figures().missed, 0U) << "what came before the recording is no part of it";
    EXPECT_EQ(recorder.figures().packets, 5000 - m_log.figures().begin);
    MemorySink later;
    Recorder future(m_log, later, 5002);
    append(4);
    ASSERT_TRUE(future.begin({}) && future.finish());
    EXPECT_EQ(future.figures().packets, 2U);
}

/// Little-endian numbers of a block that was written.
std::uint64_t numberAt(std::span<const std::byte> bytes, std::size_t place, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = size; i-- > 0;) {
        value = value << 8 | std::to_integer<std::uint64_t>(bytes[place + i]);
    }
    return value;
}

/// isb_starttime (2), isb_endtime (3), isb_ifrecv (4), isb_osdrop (7), isb_usrdeliv (8).
TEST(RecordingStatistics, AreThoseOfTheWholeRecording) {
    MemorySink sink;
    PcapngWriter writer(sink);
    ASSERT_TRUE(writer.begin({}));
    const ByteVector bytes = poseDatagram(1);
    for (const auto& [stamp, drops] : {std::pair{Stamp(3s), 5U}, {Stamp(2s), 0U}, {Stamp(9s), 0xffffffffU}}) {
        ASSERT_TRUE(writer.add({0, stamp, {}, drops, {.stampedByKernel = true}, bytes}, kSender));
    }
    const std::size_t start = sink.bytes.size();
    ASSERT_TRUE(writer.addStatistics());
    const auto block = std::span<const std::byte>(sink.bytes).subspan(start);
    ASSERT_EQ(numberAt(block, 0, 4), 5U);
    ASSERT_EQ(numberAt(block, 4, 4), block.size());
    std::map<std::uint64_t, std::uint64_t> options;
    for (std::size_t at = 20; numberAt(block, at, 2) != 0; at += 12) {
        ASSERT_EQ(numberAt(block, at + 2, 2), 8U);
        options[numberAt(block, at, 2)] = numberAt(block, at + 4, 8);
    }
    const auto halves = [](std::uint64_t value) { return value >> 32 | value << 32; };
    EXPECT_EQ(halves(options[2]), 2'000'000'000U);
    EXPECT_EQ(halves(options[3]), 9'000'000'000U);
    EXPECT_EQ(options[4], 3 + 5 + 0xffffffffULL);
    EXPECT_EQ(options[7], 5 + 0xffffffffULL);
    EXPECT_EQ(options[8], 3U);
}

/// A pcapng option has at most 65,535 bytes; a text is cut between characters.
TEST(RecordingTexts, AreCutBetweenCharacters) {
    for (const std::string character : {"x", "\u00e9", "\u20ac", "\U0001f600"}) {
        for (std::size_t shift = 0; shift < character.size(); ++shift) {
            std::string text(shift, 'a');
            while (text.size() < 66'000) {
                text += character;
            }
            MemorySink sink;
            PcapngWriter writer(sink);
            ASSERT_TRUE(writer.begin({text, text, text}));
            const std::vector<std::string> comments{text, "short"};
            ASSERT_TRUE(writer.add(packetOf(poseDatagram(1)), kSender, comments));
            const auto seen = recordedIn(sink.bytes);
            ASSERT_EQ(seen.size(), 1U);
            ASSERT_EQ(seen[0].comments.size(), 2U);
            const std::string& cut = seen[0].comments[0];
            EXPECT_LE(cut.size(), 65'000U);
            EXPECT_GT(cut.size(), 65'000 - character.size());
            EXPECT_TRUE(text.starts_with(cut));
            EXPECT_EQ(wire::firstInvalidUtf8(cut), cut.size());
            EXPECT_EQ(seen[0].comments[1], "short");
        }
    }
}

TEST(RecordingTexts, SayEveryOriginAndAreUnderstoodAgain) {
    for (const Transport transport :
         {Transport::Udp, Transport::Tcp, Transport::File, Transport::Performer}) {
        for (unsigned bits = 0; bits < 64; ++bits) {
            PacketFlags flags{(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0};
            flags.isLostOnWay = (bits & 16) != 0;
            flags.dropsUncounted = (bits & 32) != 0;
            const std::string probe = flags.isLostOnWay ? "STAGE-A" : "";
            for (const std::optional<std::string>& address :
                 {std::optional<std::string>{}, {""}, {"a; truncated"}, {"x; from y"}, {"\u00e9\n"}}) {
                for (const std::int64_t setBy :
                     std::initializer_list<std::int64_t>{0, 1, -1, 1'500'000'000, -3'600'000'000'001}) {
                    const RecordedOrigin origin{transport, flags, address, Duration(setBy), probe};
                    EXPECT_EQ(parseOrigin(originText(origin)), origin) << originText(origin);
                    EXPECT_EQ(parseOrigin(originText(origin) + ";").has_value(), address.has_value());
                }
            }
        }
    }
}

/// Blocks and options begin at multiples of four bytes, and a block ends with its length.
TEST(RecordingTexts, ArePaddedWhateverTheirLength) {
    constexpr std::size_t start = 24; // of the options of a section header
    constexpr std::size_t length = 4;
    const auto sectionWith = [](const RecordingInfo& info) {
        MemorySink sink;
        PcapngWriter writer(sink);
        EXPECT_TRUE(writer.begin(info));
        sink.bytes.resize(static_cast<std::size_t>(numberAt(sink.bytes, 4, 4)));
        return sink.bytes;
    };
    for (std::size_t size = 1; size < 20; ++size) {
        const ByteVector block =
            sectionWith({.hardware = std::string(size, 'x'), .system = {}, .application = {}});
        const std::size_t padded = (size + 3) / 4 * 4;
        ASSERT_EQ(block.size(), start + 4 + padded + 4 + length) << "an empty text is left out";
        EXPECT_EQ(numberAt(block, block.size() - 4, 4), block.size());
        EXPECT_EQ(numberAt(block, start, 2), static_cast<std::uint16_t>(PcapngOption::Hardware));
        EXPECT_EQ(numberAt(block, start + 2, 2), size);
        EXPECT_EQ(numberAt(block, block.size() - 8, 4), 0U) << "the end of the options";
    }
    const ByteVector plain = sectionWith({});
    EXPECT_EQ(plain.size(), start + length) << "no options, no end of them";
    EXPECT_EQ(numberAt(plain, start, 4), plain.size());
}

} // namespace
} // namespace posewire::log
