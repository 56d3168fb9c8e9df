// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/computer_facts.h"

#include "core/model/session/memory_figures.h"
#include "tests/app/gui/models/stage.h"

#include <QAbstractItemModelTester>
#include <QLocale>

#include <algorithm>

namespace posewire::gui {
namespace {

class ComputerFactsTest : public testing::Test {
protected:
    [[nodiscard]] PropertyValue fact(const QString& label) const {
        const auto found = std::ranges::find(m_facts.rows(), label, &Property::label);
        EXPECT_NE(found, m_facts.rows().end()) << label.toStdString();
        return found->read();
    }
    [[nodiscard]] QString text(const QString& label) const { return fact(label).display(); }

    /// Before anything arrived nothing is good.
    void hearSomething() {
        performer::Performer performer(sending(1, {2}));
        m_stage.perform(performer, 0, 10);
        m_stage.follow();
    }

    Stage m_stage;
    ReceivingState m_receiving;
    MonitorHealth m_health;
    PropertyModel m_facts{computerFacts(m_stage.session, m_receiving, m_health)};
    QAbstractItemModelTester m_tester{&m_facts, QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(ComputerFactsTest, CallNothingGoodBeforeAnythingArrived) {
    const auto isGood = [](const Property& fact) { return fact.read().health == Health::Good; };
    EXPECT_TRUE(std::ranges::none_of(m_facts.rows(), isGood));
    hearSomething();
    EXPECT_TRUE(std::ranges::any_of(m_facts.rows(), isGood));
}

TEST_F(ComputerFactsTest, TellWhatThisComputerDropped) {
    log::Arrival arrival;
    arrival.stamp = Stage::kStart;
    arrival.sender = m_stage.sender();
    arrival.kernelDropsBefore = 17;
    wire::Datagram datagram;
    datagram.body = smallPose();
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    m_stage.log.writer().append(*wire::encode(datagram), arrival);
    m_stage.log.writer().publish();
    m_stage.follow();
    EXPECT_EQ(text("Dropped here"), QStringLiteral("■ 17"));
}

TEST_F(ComputerFactsTest, TellWhoseLossesTheyWereInTheRange) {
    EXPECT_EQ(text("Lost by cause"), QStringLiteral("nothing lost"));
    EXPECT_EQ(text("Longest gap"), QStringLiteral("none"));
    performer::Performer performer(sending(1, {2}, 100.0));
    m_stage.perform(performer, 0, 1000, [](std::uint64_t frame) { return frame < 500 || frame > 503; });
    m_stage.follow();
    EXPECT_EQ(text("Lost by cause"), QStringLiteral("sender 4"));
    EXPECT_EQ(text("Longest gap"), QStringLiteral("4 samples"));
    const auto rangeOf = [](int from, int to) {
        return model::RangeChoice{0s, model::TimeRange{Stage::kStart + from * 1s, Stage::kStart + to * 1s}};
    };
    m_stage.session.setRange(rangeOf(7, 9));
    EXPECT_EQ(text("Lost by cause"), QStringLiteral("● nothing lost"));
    EXPECT_EQ(text("Longest gap"), QStringLiteral("● none"));
    m_stage.session.setRange(rangeOf(4, 6));
    EXPECT_EQ(text("Lost by cause"), QStringLiteral("sender 4"));
}

TEST_F(ComputerFactsTest, CountIncompleteSamplesAsLostInARangeAsInReports) {
    const auto pose = [](std::uint32_t sample, std::uint8_t index, bool isLast) {
        wire::Datagram datagram;
        datagram.body = smallPose();
        datagram.header.sampleCounter = sample;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        datagram.header.datagramCounter = static_cast<std::uint8_t>(index | (isLast ? 0x80 : 0));
        return datagram;
    };
    for (std::uint32_t sample = 0; sample < 600; ++sample) { // of sample 300 the second half is missing
        m_stage.send(pose(sample, 0, false), Stage::kStart + sample * 10ms);
        if (sample != 300) {
            m_stage.send(pose(sample, 1, true), Stage::kStart + sample * 10ms + 1ms);
        }
    }
    m_stage.follow();
    const QString all = text("Lost by cause");
    EXPECT_TRUE(all.endsWith(" 1")) << all.toStdString();
    m_stage.session.setRange({0s, model::TimeRange{Stage::kStart + 2s, Stage::kStart + 4s}});
    EXPECT_EQ(text("Lost by cause"), QStringLiteral("network 1"));
}

TEST_F(ComputerFactsTest, TellFillProcessorAndMemoryAndNothingThatIsNotKnown) {
    hearSomething();
    EXPECT_EQ(text("This computer"), QStringLiteral("● buffer – · dropped 0 in all · 0 fps"));
    EXPECT_EQ(text("Processor"), QStringLiteral("receiving – · program –"));
    m_health = {0.61, 0.021, 1.5, std::uint64_t{412} << 20, 0.92, 0.0123, 59.6};
    EXPECT_EQ(text("This computer"), QStringLiteral("▲ buffer 61 % · dropped 0 in all · 60 fps"));
    EXPECT_EQ(text("Processor"), QStringLiteral("receiving 2.1 % · program 150 %"));
    EXPECT_EQ(text("Accounting"), QStringLiteral("0.92 µs a packet · 1.2 %"));
    EXPECT_TRUE(text("Memory").startsWith("412 MB"));
}

TEST_F(ComputerFactsTest, TellHowPicturesAreDrawnAndWhy) {
    hearSomething();
    EXPECT_EQ(text("Picture"), QStringLiteral("–"));
    m_health.picture = {"step 7 of 7: half rate · 31 ms", "a picture took 60 ms", true};
    EXPECT_EQ(text("Picture"), QStringLiteral("step 7 of 7: half rate · 31 ms"));
    EXPECT_EQ(fact("Picture").toolTip, QStringLiteral("a picture took 60 ms"));
}

TEST_F(ComputerFactsTest, TellTheMemoryByItsPartsAndItsBudget) {
    m_health.meshBytes = std::size_t{37} << 20;
    m_health.mostMeshBytes = std::size_t{64} << 20;
    performer::Performer performer(sending(1, {2}, 100.0));
    m_stage.perform(performer, 0, 1000);
    m_stage.follow();
    const model::MemoryFigures kept = m_stage.session.memory();
    const std::size_t budget = (kept.budget() + m_health.mostMeshBytes + (1U << 19)) >> 20;
    EXPECT_TRUE(text("Memory").endsWith(QString("of %1 MB").arg(budget))) << text("Memory").toStdString();
    EXPECT_TRUE(text("Memory by part").contains("bodies drawn 37")) << text("Memory by part").toStdString();
    EXPECT_TRUE(text("Memory by part").startsWith("packets "));
    EXPECT_TRUE(fact("Memory by part").toolTip.contains("bodies drawn 37 MB of 64 MB"));
    for (const model::MemoryFigures::Part& part : kept.parts) {
        EXPECT_TRUE(fact("Memory by part").toolTip.contains(part.name)) << part.name;
    }
}

TEST_F(ComputerFactsTest, FollowTheStateOfReceivingAndWarnOfASmallBuffer) {
    hearSomething();
    EXPECT_EQ(text("Receive buffer"), "no UDP port");
    m_receiving.receiveBufferBytes = std::int64_t{4} << 20;
    EXPECT_EQ(text("Receive buffer"), QStringLiteral("● 4 MB"));
    m_receiving.receiveBufferBytes = 212'992 / 2;
    EXPECT_EQ(text("Receive buffer"), QStringLiteral("▲ 104 KB"));
    EXPECT_TRUE(fact("Receive buffer").toolTip.contains("rmem_max"));
    const QLocale before;
    QLocale::setDefault(QLocale(QLocale::German));
    m_receiving.longestDelay = 47'300us;
    EXPECT_EQ(text("Longest delay"), QStringLiteral("● 47.3 ms")) << "as all numbers, in every country";
    QLocale::setDefault(before);
    EXPECT_EQ(fact("Longest delay").health, Health::Good);
    m_receiving.longestDelay = 400ms;
    EXPECT_EQ(fact("Longest delay").health, Health::Warning);
}

} // namespace
} // namespace posewire::gui
