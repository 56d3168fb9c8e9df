// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/packet_model.h"

#include "app/gui/models/column.h"
#include "app/gui/models/packet_search.h"
#include "core/model/session/accounts.h"
#include "tests/app/gui/models/stage.h"
#include "tests/support/golden.h"

#include <QAbstractItemModelTester>
#include <QSignalSpy>

#include <random>

namespace posewire::gui {
namespace {

class PacketModelTest : public testing::Test {
protected:
    void refresh() {
        m_stage.follow();
        m_model.refresh();
    }
    /// A pose with this sample counter, a hundredth of a second after the last packet.
    void pose(std::uint32_t sample) {
        m_stage.send(smallPose(), sample, sample * 10, Stage::kStart + m_sent++ * 10ms);
    }
    void steadyPoses(std::uint32_t count) {
        for (std::uint32_t sample = 0; sample < count; ++sample) {
            pose(sample);
        }
    }
    [[nodiscard]] QString text(int row, int column) const {
        return m_model.index(row, column).data().toString();
    }
    [[nodiscard]] QString lastNote() {
        refresh();
        return text(m_model.rowCount() - 1, PacketModel::kNote);
    }

    Stage m_stage;
    PacketModel m_model{m_stage.session};
    QAbstractItemModelTester m_tester{&m_model, QAbstractItemModelTester::FailureReportingMode::Fatal};
    std::int64_t m_sent = 0;
};

TEST_F(PacketModelTest, ListsWhatIsKnownAboutAPacket) {
    m_stage.sendMetadata("name:Mira\n", Stage::kStart);
    m_sent = 1;
    pose(153'401);
    pose(153'402);
    refresh();
    ASSERT_EQ(m_model.rowCount(), 3);
    EXPECT_EQ(text(2, PacketModel::kNumber), "2");
    EXPECT_EQ(text(2, PacketModel::kTime), "0.0200");
    EXPECT_EQ(text(2, PacketModel::kDelta), "10.00");
    EXPECT_EQ(text(2, PacketModel::kSender), Stage::kAddress);
    EXPECT_EQ(text(2, PacketModel::kType), "02 Pose, quaternion");
    EXPECT_EQ(text(2, PacketModel::kCharacter), "0");
    EXPECT_EQ(m_model.index(2, PacketModel::kCharacter).data(kSuffixRole).toString(), "Mira");
    EXPECT_EQ(text(2, PacketModel::kSample), QString::fromUtf8("153\u202f402"));
    EXPECT_EQ(text(2, PacketModel::kPart), "1/1");
    EXPECT_EQ(text(2, PacketModel::kSize), "56");
    EXPECT_EQ(text(2, PacketModel::kNote), "");
}

TEST_F(PacketModelTest, CountsTimesFromWhereTheOperatorWants) {
    pose(0);
    m_stage.sendMetadata("name:Mira\n", Stage::kStart + 4ms);
    m_sent = 1;
    pose(1);
    refresh();
    m_model.setDeltaMode(PacketModel::DeltaMode::RowAbove);
    EXPECT_EQ(text(2, PacketModel::kDelta), "6.00");
    m_model.setTimeMode(PacketModel::TimeMode::TimeOfDay);
    EXPECT_EQ(text(2, PacketModel::kTime), "2023-11-14 22:13:20.010000");
}

TEST_F(PacketModelTest, NotesInWordsHowAPacketRelatesToItsStream) {
    steadyPoses(20);
    EXPECT_EQ(lastNote(), "");
    pose(24);
    EXPECT_EQ(lastNote(), QStringLiteral("▲ gap: 4 missing"));
    pose(24);
    EXPECT_EQ(lastNote(), QStringLiteral("▲ duplicate"));
    pose(22);
    EXPECT_EQ(lastNote(), QStringLiteral("▲ reordered"));
    pose(26);
    EXPECT_EQ(lastNote(), QStringLiteral("▲ gap: 1 missing"));
    pose(1'000'000);
    EXPECT_EQ(lastNote(), QStringLiteral("▲ counter jumped"));
}

TEST_F(PacketModelTest, NotesWhoseLossAGapIsAndNothingOnceItIsFilled) {
    const auto poses = [this](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t sample = first; sample <= last; ++sample) {
            pose(sample);
        }
        refresh();
    };
    steadyPoses(20);
    poses(24, 60);
    EXPECT_EQ(text(20, PacketModel::kNote), QStringLiteral("▲ cause unknown: 4 lost"));
    poses(20, 23);
    poses(61, 80);
    EXPECT_EQ(text(20, PacketModel::kNote), "") << "they were very late";
}

TEST_F(PacketModelTest, NotesInWordsWhatIsWrongWithTheBytes) {
    const auto& whole = test::golden("02_quaternion_counted").bytes;
    m_stage.sendBytes(wire::Bytes(whole).first(whole.size() - 8), Stage::kStart);
    EXPECT_TRUE(lastNote().startsWith(QStringLiteral("■ malformed: "))) << lastNote().toStdString();
    EXPECT_TRUE(lastNote().contains("needs")) << lastNote().toStdString();
    const std::string_view foreign = "GET / HTTP/1.1\r\n";
    m_stage.sendBytes(std::as_bytes(std::span(foreign)), Stage::kStart + 1ns);
    EXPECT_TRUE(lastNote().startsWith(QStringLiteral("▲ foreign: 47 45 54"))) << lastNote().toStdString();
    EXPECT_EQ(text(1, PacketModel::kType), "foreign");
    std::vector<std::byte> longer(whole);
    longer.resize(whole.size() + 3);
    m_stage.sendBytes(longer, Stage::kStart + 2ns);
    EXPECT_TRUE(lastNote().contains("byte")) << lastNote().toStdString();
}

TEST_F(PacketModelTest, NotesWhatThisComputerDroppedMarksAndComments) {
    log::Arrival arrival;
    arrival.stamp = Stage::kStart;
    arrival.sender = m_stage.sender();
    arrival.kernelDropsBefore = 12;
    m_stage.log.writer().append(test::golden("02_quaternion_counted").bytes, arrival);
    m_stage.log.writer().publish();
    EXPECT_TRUE(lastNote().contains("this computer dropped 12 before")) << lastNote().toStdString();
    steadyPoses(1);
    refresh();
    QSignalSpy changed(&m_model, &QAbstractItemModel::dataChanged);
    m_stage.session.setComment(1, "look here");
    m_stage.session.setMarked(1, true);
    EXPECT_TRUE(lastNote().contains(QStringLiteral("“look here”"))) << lastNote().toStdString();
    EXPECT_EQ(changed.count(), 1);
}

TEST_F(PacketModelTest, AnnouncesOneInsertionForManyPackets) {
    QSignalSpy inserted(&m_model, &QAbstractItemModel::rowsInserted);
    QSignalSpy changed(&m_model, &QAbstractItemModel::dataChanged);
    steadyPoses(5'000);
    refresh();
    EXPECT_EQ(inserted.count(), 1);
    EXPECT_EQ(changed.count(), 0);
    EXPECT_EQ(m_model.rowCount(), 5'000);
}

TEST(PacketModel, AnnouncesOneRemovalForWhatTheLogDropped) {
    log::PacketLog log({.memoryCap = 1 << 20, .chunkSize = 1 << 18});
    model::Session session(log);
    PacketModel model(session);
    QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::Fatal);
    QSignalSpy removed(&model, &QAbstractItemModel::rowsRemoved);
    QSignalSpy inserted(&model, &QAbstractItemModel::rowsInserted);
    const auto& bytes = test::golden("02_quaternion_counted").bytes;
    const auto sender = log.senders().intern({"sender", log::Transport::Udp, 9763});
    int rounds = 0;
    while (session.begin() == 0) {
        for (int i = 0; i < 500; ++i) {
            log.writer().append(bytes, {.stamp = Stage::kStart, .sender = sender});
        }
        log.writer().publish();
        session.follow(Stage::kStart);
        model.refresh();
        ++rounds;
    }
    EXPECT_EQ(inserted.count(), rounds);
    EXPECT_EQ(removed.count(), 1);
    EXPECT_EQ(model.packetAt(0), session.begin());
    EXPECT_EQ(model.packetAt(model.rowCount() - 1), session.end() - 1);
    EXPECT_EQ(model.rowOf(0), -1);
}

TEST_F(PacketModelTest, ListsWhatAFilterLetsThroughAndFollowsIt) {
    steadyPoses(3'000);
    for (int i = 0; i < 7; ++i) {
        m_stage.sendMetadata("name:Mira\n", Stage::kStart);
    }
    refresh();
    m_model.beginMatches();
    PacketFilterRun run(m_stage.session, *filter::Filter::compile("type == 12"));
    const auto take = [&] {
        run.wait();
        return run.take(m_stage.session);
    };
    m_model.addMatches(take());
    refresh();
    EXPECT_EQ(m_model.rowCount(), 7);
    EXPECT_EQ(m_model.packetAt(0), 3'000U);
    EXPECT_EQ(m_model.rowOf(2'999), -1);
    m_stage.sendMetadata("name:Ana\n", Stage::kStart);
    EXPECT_TRUE(take().empty()) << "the session has not followed yet";
    m_stage.follow();
    EXPECT_TRUE(take().empty()) << "handed over by this call only";
    m_model.addMatches(take());
    refresh();
    EXPECT_EQ(m_model.rowCount(), 8);
    m_model.endMatches();
    EXPECT_EQ(m_model.rowCount(), 3'008);
}

TEST_F(PacketModelTest, FilterStopsAtOnceWhenItIsCancelled) {
    steadyPoses(50'000);
    PacketFilterRun run(m_stage.session, *filter::Filter::compile("type == 02"));
    run.cancel();
    run.wait();
    const auto found = run.take(m_stage.session).size();
    EXPECT_TRUE(run.isCancelled());
    pose(60'000);
    m_stage.follow();
    run.wait();
    EXPECT_LE(run.take(m_stage.session).size() + found, 50'000U);
}

TEST(PacketModel, FilterAndListAgreeOnPacketsWhosePredecessorsWereDropped) {
    log::PacketLog log({.memoryCap = 1 << 20, .chunkSize = 1 << 18});
    model::Session session(log);
    std::vector<std::byte> bytes = test::golden("02_quaternion_counted").bytes;
    const auto sender = log.senders().intern({"sender", log::Transport::Udp, 9763});
    std::uint32_t sample = 0;
    while (session.begin() == 0) {
        for (int i = 0; i < 500; ++i) {
            sample += i % 5 == 4 ? 3 : 1; // two are missing again and again
            bytes[8] = static_cast<std::byte>(sample >> 8);
            bytes[9] = static_cast<std::byte>(sample);
            log.writer().append(bytes, {.stamp = Stage::kStart, .sender = sender});
        }
        log.writer().publish();
        session.follow(Stage::kStart);
    }
    session.follow(Stage::kStart + 3s); // by then all of them are judged
    PacketFilterRun run(session, *filter::Filter::compile("gap > 0"));
    run.wait();
    std::vector<std::uint64_t> gaps;
    for (std::uint64_t number = session.accounts().digests().begin();
         number < session.accounts().digests().end(); ++number) {
        if (session.accounts().digests().find(number)->gap > 0) {
            gaps.push_back(number);
        }
    }
    EXPECT_EQ(run.take(session), gaps);
}

TEST_F(PacketModelTest, FilterWaitsUntilItIsKnownWhatIsLost) {
    steadyPoses(200);
    pose(202);
    pose(200);
    pose(201); // both came after all
    pose(204);
    refresh();
    PacketFilterRun gaps(m_stage.session, *filter::Filter::compile("gap > 0"));
    PacketFilterRun poses(m_stage.session, *filter::Filter::compile("type == 02"));
    EXPECT_EQ(poses.progress().total, 204U);
    EXPECT_LT(gaps.progress().total, 204U);
    for (std::uint32_t sample = 205; sample < 250; ++sample) {
        pose(sample);
    }
    refresh();
    static_cast<void>(gaps.take(m_stage.session));
    gaps.wait();
    EXPECT_EQ(gaps.take(m_stage.session), std::vector<std::uint64_t>{203}) << "203 never came";
    EXPECT_EQ(gaps.progress().total, 249U);
}

TEST_F(PacketModelTest, FilterFindsARestartThatWasInDoubt) {
    steadyPoses(200);
    refresh();
    PacketFilterRun run(m_stage.session, *filter::Filter::compile("restart"));
    std::vector<std::uint64_t> found;
    const auto take = [&] { std::ranges::copy(run.take(m_stage.session), std::back_inserter(found)); };
    for (std::uint32_t sample = 90'000; sample < 90'020; ++sample) {
        pose(sample);
        refresh();
        take();
    }
    run.wait();
    take();
    EXPECT_EQ(found, std::vector<std::uint64_t>{200});
}

TEST(PacketModel, FilterCountsWhatLeftTheLogBeforeItLookedAtIt) {
    log::PacketLog log({.memoryCap = 1, .chunkSize = 1 << 18});
    model::Session session(log);
    const std::vector<std::byte> bytes = test::golden("02_quaternion_counted").bytes;
    const auto sender = log.senders().intern({"sender", log::Transport::Udp, 9763});
    const auto append = [&](int count) {
        for (int i = 0; i < count; ++i) {
            log.writer().append(bytes, {.stamp = Stage::kStart, .sender = sender});
        }
        log.writer().publish();
    };
    append(100);
    session.follow(Stage::kStart);
    append(10'000); // the log drops all that the session knows
    PacketFilterRun run(session, *filter::Filter::compile("type == 02"));
    run.wait();
    EXPECT_EQ(run.progress().gone, 100U);
    EXPECT_EQ(run.progress().done, 100U);
    EXPECT_TRUE(run.take(session).empty());
    session.follow(Stage::kStart);
    static_cast<void>(run.take(session));
    run.wait();
    const auto progress = run.progress();
    EXPECT_EQ(progress.done, progress.total);
    EXPECT_EQ(run.take(session).size() + progress.gone, 10'100U);
}

TEST_F(PacketModelTest, PaintsEveryCellOfDamagedDatagrams) {
    std::mt19937 random(7);
    for (int i = 0; i < 4'000; ++i) {
        const auto& goldens = test::goldens();
        std::vector<std::byte> bytes = goldens[static_cast<std::size_t>(i) % goldens.size()].bytes;
        bytes.resize(random() % 3 == 0 ? random() % (bytes.size() + 1) : bytes.size());
        for (unsigned flips = random() % 4; flips > 0 && !bytes.empty(); --flips) {
            bytes[random() % std::min<std::size_t>(bytes.size(), 64)] = static_cast<std::byte>(random());
        }
        m_stage.sendBytes(bytes, Stage::kStart + i * 1ns);
    }
    refresh();
    qsizetype written = 0;
    for (int row = 0; row < m_model.rowCount(); ++row) {
        for (int column = 0; column < m_model.columnCount(); ++column) {
            const QModelIndex index = m_model.index(row, column);
            for (const int role : {int{Qt::DisplayRole}, int{Qt::ForegroundRole}, int{Qt::ToolTipRole},
                                   kSuffixRole, kDotRole}) {
                written += index.data(role).toString().size();
            }
        }
        if (m_stage.session.accounts().digests().find(static_cast<std::uint64_t>(row))->isProblem()) {
            EXPECT_FALSE(text(row, PacketModel::kNote).isEmpty()) << row;
        }
    }
    EXPECT_GT(written, 4'000 * 20);
}

} // namespace
} // namespace posewire::gui
