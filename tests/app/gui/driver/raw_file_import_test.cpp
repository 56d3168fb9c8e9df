// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/opened_file.h"

#include "core/log/output_file.h"
#include "core/log/pcapng_writer.h"
#include "tests/app/gui/models/stage.h"

#include <QFile>
#include <QTemporaryDir>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

class RawFileImport : public testing::Test {
protected:
    /// A sample for each time code; two that are the same are of one sample.
    void writeFile(const std::vector<std::uint32_t>& timeCodes) const {
        QFile file(path);
        ASSERT_TRUE(file.open(QIODevice::WriteOnly));
        std::uint32_t sample = 0;
        std::optional<std::uint32_t> before;
        for (const std::uint32_t timeCode : timeCodes) {
            sample += std::exchange(before, timeCode) == timeCode ? 0 : 1;
            wire::Datagram datagram;
            datagram.header.sampleCounter = sample;
            datagram.body = smallPose();
            datagram.header.timeCode = timeCode;
            wire::completeHeader(datagram, wire::HeaderEra::Counted);
            const auto bytes = wire::encode(datagram);
            ASSERT_TRUE(bytes);
            file.write(reinterpret_cast<const char*>(bytes->data()), static_cast<qint64>(bytes->size()));
        }
    }
    QString import(const QString& file) {
        const auto imported = importRawFile(
            file,
            [this](const log::FileRecord& record, const log::SenderInfo& sender, log::Arrival arrival) {
                arrival.sender = log.senders().intern(sender);
                log.writer().append(record.bytes, arrival);
                log.writer().publish();
            },
            Stage::kStart, log.timeline());
        return imported ? *imported : imported.error();
    }
    std::vector<log::Stamp> stamps() {
        std::vector<log::Stamp> result;
        log::LogReader reader(log);
        reader.refresh();
        for (std::uint64_t number = reader.begin(); number != reader.end(); ++number) {
            result.push_back(reader.packet(number)->stamp);
        }
        return result;
    }

    QTemporaryDir folder;
    QString path = folder.filePath("take.bin");
    log::PacketLog log{{.memoryCap = std::size_t{4} << 20, .chunkSize = std::size_t{1} << 20}};
};

TEST_F(RawFileImport, SpacesDatagramsByTheirTimeCodesWithTheNewestAtTheEnd) {
    writeFile({1000, 1000, 1010, 1030});
    ASSERT_EQ(import(path), "");
    EXPECT_EQ(stamps(), (std::vector<log::Stamp>{Stage::kStart - 30ms, Stage::kStart - 30ms,
                                                 Stage::kStart - 20ms, Stage::kStart}));
}

TEST_F(RawFileImport, ACutCaptureIsReadUpToItsEndWhichIsTold) {
    {
        const auto sink = log::createFile(path.toStdString());
        ASSERT_TRUE(sink);
        log::PcapngWriter writer(**sink);
        ASSERT_TRUE(writer.begin({}));
        const std::vector<std::byte> bytes(40, std::byte{7});
        for (int i = 0; i < 3; ++i) {
            log::Packet packet;
            packet.stamp = Stage::kStart + i * 1ms;
            packet.bytes = bytes;
            ASSERT_TRUE(writer.add(packet, {"10.0.0.5:50000", log::Transport::Udp, 9763}));
        }
    }
    const qint64 size = QFile(path).size() - 10;
    ASSERT_TRUE(QFile::resize(path, size));
    EXPECT_EQ(import(path),
              path + QStringLiteral(": is cut off: it ends at byte %1, amidst a packet; what comes "
                                    "before that packet was read")
                         .arg(size));
    EXPECT_EQ(stamps().size(), 2U);
}

TEST_F(RawFileImport, NothingWithoutAnEndIsRead) {
    EXPECT_TRUE(import("/dev/zero").contains("a pipe or a device"));
    EXPECT_TRUE(stamps().empty());
}

TEST_F(RawFileImport, TimeCodesThatGoBackDoNotMoveTheStampsBack) {
    writeFile({1000, 1020, 5, 15});
    ASSERT_EQ(import(path), "");
    const auto found = stamps();
    EXPECT_TRUE(std::ranges::is_sorted(found));
    EXPECT_EQ(found.back(), Stage::kStart);
}

TEST_F(RawFileImport, APeriodPassesWhereTimeCodesFreezeOrJump) {
    writeFile({1000, 1020, 5, 900'000, 900'010});
    ASSERT_EQ(import(path), "");
    const std::vector<log::Stamp> found = stamps();
    ASSERT_EQ(found.size(), 5U);
    const log::Duration period = std::chrono::duration_cast<log::Duration>(1s) / 240;
    EXPECT_LE(std::chrono::abs(found[2] - found[1] - period), 1ns) << "as posewire-cli has it";
    EXPECT_LE(std::chrono::abs(found[3] - found[2] - period), 1ns);
    EXPECT_EQ(found[4] - found[3], 10ms);
}

TEST_F(RawFileImport, ACaptureKeepsItsSendersTransportsStampsAndDrops) {
    const std::vector<log::SenderInfo> senders{{"10.0.0.5:50000", log::Transport::Udp, 9763},
                                               {"10.0.0.6:50001", log::Transport::Udp, 9763},
                                               {"10.0.0.7:50002", log::Transport::Tcp, 9764}};
    const std::vector<std::byte> bytes(40, std::byte{7});
    {
        const auto sink = log::createFile(path.toStdString());
        ASSERT_TRUE(sink);
        log::PcapngWriter writer(**sink);
        ASSERT_TRUE(writer.begin({}));
        for (std::size_t i = 0; i < senders.size(); ++i) {
            log::Packet packet;
            packet.stamp = Stage::kStart + static_cast<std::int64_t>(i) * 1'000'003ns;
            packet.kernelDropsBefore = i == 1 ? 17 : 0;
            packet.bytes = bytes;
            ASSERT_TRUE(writer.add(packet, senders[i]));
        }
        ASSERT_TRUE(writer.addStatistics());
    }
    ASSERT_EQ(import(path), "");
    EXPECT_EQ(stamps(), (std::vector<log::Stamp>{Stage::kStart, Stage::kStart + 1'000'003ns,
                                                 Stage::kStart + 2'000'006ns}));
    log::LogReader reader(log);
    ASSERT_EQ(reader.end(), 3U);
    for (std::size_t i = 0; i < senders.size(); ++i) {
        const auto packet = reader.packet(i);
        EXPECT_EQ(*log.senders().find(packet->sender), senders[i]);
        EXPECT_EQ(packet->kernelDropsBefore, i == 1 ? 17U : 0U);
        EXPECT_EQ(packet->bytes.size(), 40U);
    }
}

TEST_F(RawFileImport, SaysWhyAFileCannotBeRead) {
    EXPECT_NE(import(folder.filePath("none.bin")), "");
    writeFile({});
    EXPECT_NE(import(path), "");
    EXPECT_TRUE(stamps().empty());
}

} // namespace
} // namespace posewire::gui
