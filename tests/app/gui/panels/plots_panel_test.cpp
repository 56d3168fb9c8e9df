// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/curve_text.h"
#include "app/gui/panels/plots_panel.h"
#include "core/model/session/messages.h"
#include "tests/app/gui/panels/panel_stage.h"

#include <QFile>
#include <QMimeData>
#include <QTemporaryDir>
#include <QTest>
#include <QWheelEvent>

#include <cmath>

namespace posewire::gui {
namespace {

constexpr auto kHeight = "position.z of Pelvis";

/// Three seconds of a character at 240 Hz in a file; nothing between 1 and 1.5 s.
class PlotsPanelTest : public testing::Test {
protected:
    void SetUp() override {
        performer::Performer performer(sending(1, {2, 23}));
        m_stage.perform(performer, 0, 720, [](std::uint64_t frame) { return frame < 240 || frame >= 360; });
        m_stage.follow();
        m_panel.resize(1000, 500);
        m_panel.show();
        m_panel.refresh();
        m_view.setWindow({at(0s), at(3s)});
    }

    void add(const QString& text, std::optional<std::size_t> chart = {}) { m_panel.add({text}, chart); }
    /// The pelvis as sent by then, m.
    double sentHeight(log::Stamp stamp) {
        m_stage.playback.showMoment(stamp);
        const auto* message = m_stage.session.messages().message(m_stage.key(), 2);
        return static_cast<double>(
            std::get<wire::PoseQuaternion>(message->datagram.body).segments[0].position[2]);
    }
    const PlotCurve& curve(std::size_t chart = 0, std::size_t number = 0) {
        return m_view.curves().charts()[chart].curves[number];
    }
    QPoint place(log::Duration time, double share = 0.5) {
        const QRect area = m_view.shown()[0].area;
        return {static_cast<int>(std::lround(m_view.placeOf(at(time)))),
                area.top() + static_cast<int>(share * area.height())};
    }
    static log::Stamp at(log::Duration time) { return Stage::kStart + time; }

    PanelStage m_stage;
    PlotsPanel m_panel{m_stage.session, m_stage.commands, m_stage.playback, nullptr};
    PlotsView& m_view = *m_panel.findChild<PlotsView*>();
};

TEST_F(PlotsPanelTest, TheValueAtTheCursorIsTheDecodedOne) {
    add(kHeight);
    for (const log::Duration time : {200ms, 703ms, 1600ms, 2900ms}) {
        const double sent = sentHeight(at(time));
        const auto value = m_view.curves().valueAt(curve(), m_stage.session.cursorStamp());
        ASSERT_TRUE(value) << time.count();
        EXPECT_EQ(value->value, sent);
        m_panel.refresh();
        EXPECT_TRUE(m_view.valueText(0, curve(), at(time)).endsWith(QStringLiteral("m")));
    }
}

TEST_F(PlotsPanelTest, AGapStaysAGap) {
    add(kHeight);
    for (const std::size_t pixels : {2000U, 60U}) { // rows, and sums of rows
        const auto points = m_view.curves().points(curve(), m_view.window(), pixels);
        ASSERT_FALSE(points.empty());
        EXPECT_LE(points.size(), pixels == 60 ? 61U : 602U);
        EXPECT_EQ(std::ranges::count(points, true, &PlotPoint::followsGap), 1);
        for (std::size_t i = 1; i < points.size(); ++i) {
            const double step = 3.0 / static_cast<double>(pixels);
            EXPECT_EQ(points[i].followsGap, points[i].seconds - points[i - 1].seconds > 0.1 + step);
            EXPECT_LE(points[i].least, points[i].most);
        }
    }
    EXPECT_FALSE(m_view.curves().valueAt(curve(), at(1250ms))) << "nothing came then";
    EXPECT_EQ(m_view.valueText(0, curve(), at(1250ms)), QStringLiteral("–"));
}

TEST_F(PlotsPanelTest, SumsOfRowsHaveAllPeaks) {
    add(kHeight);
    const auto rows = m_view.curves().points(curve(), m_view.window(), 2000);
    const auto columns = m_view.curves().points(curve(), m_view.window(), 50);
    EXPECT_EQ(std::ranges::max(rows, {}, &PlotPoint::most).most,
              std::ranges::max(columns, {}, &PlotPoint::most).most);
    EXPECT_EQ(std::ranges::min(rows, {}, &PlotPoint::least).least,
              std::ranges::min(columns, {}, &PlotPoint::least).least);
}

TEST_F(PlotsPanelTest, CurvesOfOneUnitShareAChart) {
    m_panel.add(
        {"position.x of Pelvis", "position.y of Pelvis", "freeAcceleration.x of Pelvis", kHeight, kHeight});
    ASSERT_EQ(m_view.curves().charts().size(), 2U);
    EXPECT_EQ(m_view.curves().charts()[0].curves.size(), 3U) << "and none twice";
    EXPECT_EQ(m_view.curves().charts()[0].unit(), "m");
    m_view.curves().moveApart(0, 1);
    EXPECT_EQ(m_view.curves().charts().size(), 3U);
    add("position.q of Pelvis");
    EXPECT_EQ(m_view.curves().count(), 4U);
    EXPECT_NE(m_panel.findChild<PassingMessage*>()->said(), "");
}

TEST_F(PlotsPanelTest, AClickShowsThatMomentAndDraggingMovesTheWindow) {
    add(kHeight);
    QTest::mouseClick(&m_view, Qt::LeftButton, {}, place(2s));
    EXPECT_NEAR(log::secondsOf(m_stage.session.cursorStamp() - at(2s)), 0, 0.005);
    EXPECT_EQ(m_stage.session.choices().cursor.mode, model::Cursor::Mode::Paused);
    m_view.setWindow({at(500ms), at(1500ms)});
    QTest::mousePress(&m_view, Qt::LeftButton, {}, place(1s));
    QTest::mouseMove(&m_view, place(750ms));
    QTest::mouseRelease(&m_view, Qt::LeftButton, {}, place(750ms));
    EXPECT_NEAR(log::secondsOf(m_view.window().from - at(750ms)), 0, 0.005);
    EXPECT_NEAR(log::secondsOf(m_stage.session.cursorStamp() - at(2s)), 0, 0.005) << "it is no click";
}

TEST_F(PlotsPanelTest, TheWheelZoomsAboutThePointer) {
    add(kHeight);
    const QPoint pointer = place(2s);
    QWheelEvent turn(pointer, m_view.mapToGlobal(pointer), {}, {0, 240}, {}, {}, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(&m_view, &turn);
    EXPECT_NEAR(log::secondsOf(m_view.window().to - m_view.window().from), 3 * 0.64, 0.01);
    EXPECT_NEAR(m_view.placeOf(at(2s)), pointer.x(), 2);
    m_panel.showAll();
    EXPECT_NEAR(log::secondsOf(m_view.window().to - m_view.window().from), 3, 0.01);
}

TEST_F(PlotsPanelTest, ADoubleClickLeadsToThePacket) {
    add(kHeight);
    const double x = m_view.placeOf(at(2s));
    const auto value = m_view.curves().valueAt(curve(), m_view.stampAt(std::round(x)));
    ASSERT_TRUE(value);
    QTest::mouseDClick(&m_view, Qt::LeftButton, {},
                       {static_cast<int>(std::lround(x)), static_cast<int>(m_view.placeOf(0, value->value))});
    EXPECT_EQ(m_stage.session.choices().selection.packet, value->row.packet);
    EXPECT_EQ(m_stage.asked.dock, "packets");
}

TEST_F(PlotsPanelTest, ShiftAndDraggingSelectARange) {
    add(kHeight);
    QTest::mousePress(&m_view, Qt::LeftButton, Qt::ShiftModifier, place(1s));
    QTest::mouseMove(&m_view, place(2s));
    QTest::mouseRelease(&m_view, Qt::LeftButton, Qt::ShiftModifier, place(2s));
    const auto range = m_stage.session.choices().range.fixed;
    ASSERT_TRUE(range);
    EXPECT_NEAR(log::secondsOf(range->from - at(1s)), 0, 0.01);
    EXPECT_NEAR(log::secondsOf(range->to - at(2s)), 0, 0.01);
}

TEST_F(PlotsPanelTest, AnotherMomentReadsAndPaintsNoCurveAgain) {
    add(kHeight);
    const auto version = m_view.curves().version();
    const auto* points = m_view.shown()[0].points[0].data();
    m_stage.playback.showMoment(at(700ms));
    m_panel.refresh();
    EXPECT_EQ(m_view.curves().version(), version);
    EXPECT_EQ(m_view.shown()[0].points[0].data(), points);
}

TEST_F(PlotsPanelTest, ReadsALongLogInTheBackgroundAndAllOfIt) {
    performer::Performer performer(sending(1, {2, 23}));
    m_stage.perform(performer, 720, 12'000);
    m_stage.follow();
    add(kHeight);
    for (int i = 0; i < 500 && m_view.curves().isReading(); ++i) {
        QTest::qWait(2);
        m_panel.refresh();
    }
    ASSERT_FALSE(m_view.curves().isReading());
    EXPECT_TRUE(m_view.curves().valueAt(curve(), at(49'900ms)));
    const auto points = m_view.curves().points(curve(), {at(0s), at(50s)}, 100'000);
    EXPECT_EQ(points.size(), 12'000U - 120U);
}

TEST_F(PlotsPanelTest, CurvesAreKeptWithTheLayoutAndInFiles) {
    m_panel.add({"position.x of Pelvis", kHeight, "freeAcceleration.x of Pelvis"});
    m_view.curves().toggleLog(1);
    m_view.curves().setRange(0, std::pair(-1.0, 2.5));
    const QJsonObject state = m_panel.state();
    PlotsPanel other(m_stage.session, m_stage.commands, m_stage.playback, nullptr);
    other.restoreState(state);
    EXPECT_EQ(other.state(), state);
    const QTemporaryDir folder;
    const QString path = folder.filePath("curves.json");
    QFile file(path);
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(R"({"charts": [{"curves": [{"signal": "no such field"}, 3]}, {"curves": 7}, 5]})");
    file.close();
    EXPECT_NE(other.openFrom(path), "");
    EXPECT_EQ(other.state(), state) << "what has no curves replaces none";
}

TEST_F(PlotsPanelTest, FilesHaveThePictureOrTheValuesInView) {
    m_panel.add({kHeight, "freeAcceleration.x of Pelvis"});
    m_view.setWindow({at(500ms), at(900ms)});
    const QTemporaryDir folder;
    for (const auto& [suffix, begin] : {std::pair{"png", "\x89PNG"}, {"svg", "<?xml"}, {"pdf", "%PDF"}}) {
        const QString path = folder.filePath(QStringLiteral("plots.") + suffix);
        EXPECT_EQ(m_panel.saveTo(path), "");
        QFile file(path);
        ASSERT_TRUE(file.open(QIODevice::ReadOnly));
        EXPECT_TRUE(file.readAll().startsWith(begin)) << suffix;
    }
    const QString path = folder.filePath("plots.csv");
    ASSERT_EQ(m_panel.saveTo(path), "");
    QFile file(path);
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    const QList<QByteArray> lines = file.readAll().trimmed().split('\n');
    EXPECT_EQ(lines.front(),
              R"(time_s,packet,sample,"position.z of Pelvis [m]","freeAcceleration.x of Pelvis [m/s²]")");
    ASSERT_EQ(lines.size(), 1 + 2 * 96) << "0.4 s of two types at 240 Hz";
    const QList<QByteArray> cells = lines[1].split(',');
    ASSERT_EQ(cells.size(), 5);
    EXPECT_EQ(cells[3].toDouble(), sentHeight(at(500ms)));
}

TEST_F(PlotsPanelTest, OtherDocksAskForCurvesOfTheirFields) {
    m_stage.commands.plot(curvesOfTracker("freeAcceleration", 11));
    EXPECT_EQ(m_stage.asked.dock, "plots");
    ASSERT_EQ(m_view.curves().count(), 3U);
    EXPECT_EQ(m_view.curves().charts()[0].unit(), QStringLiteral("m/s²"));
    const auto packet = m_stage.session.packet(0);
    const FieldDocument document(*packet, model::LengthUnit::Metre);
    EXPECT_EQ(curvesOf(document, document.find("segments[6].position")).size(), 3);
    const QStringList one = curvesOf(document, document.find("segments[0].position.z"));
    ASSERT_EQ(one.size(), 1);
    EXPECT_TRUE(one.front().contains("position.z of")) << one.front().toStdString();
    EXPECT_TRUE(curvesOf(document, document.find("segments")).isEmpty());
    const std::unique_ptr<QMimeData> dragged(asDragged(one));
    EXPECT_EQ(draggedCurves(*dragged), one);
}

} // namespace
} // namespace posewire::gui
