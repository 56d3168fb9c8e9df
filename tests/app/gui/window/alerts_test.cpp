// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/text.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/window/alerts.h"
#include "app/gui/window/health_bar.h"
#include "app/gui/window/health_popup.h"
#include "app/gui/window/menus.h"
#include "core/model/session/accounts.h"
#include "tests/app/gui/models/stage.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QFile>
#include <QFormLayout>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTest>

namespace posewire::gui {

namespace {

TEST(AlertChoicesTest, AreReadBackAsTheyWereWritten) {
    AlertChoices choices;
    choices.thresholds.lossPercent = 2.5;
    choices.thresholds.hysteresis = 0.5;
    choices.hasErrorSound = true;
    choices.hasNotification = true;
    EXPECT_EQ(alertChoicesOf(jsonOf(choices)), choices);
    EXPECT_EQ(alertChoicesOf({}), AlertChoices());
}

TEST(AlertChoicesTest, WhatMakesNoSenseIsAsShipped) {
    const QJsonObject object{{"lossPercent", -3}, {"windowS", 0}, {"hysteresis", 7}, {"jitterMs", "soon"}};
    EXPECT_EQ(alertChoicesOf(object), AlertChoices());
}

TEST(AlertSoundsTest, SoundOnceForAnIncidentAndNeverForThePast) {
    model::Incidents incidents;
    AlertChoices choices;
    choices.hasErrorSound = true;
    model::Occurrence one;
    one.kind = model::IncidentKind::Local;
    incidents.report(one);
    AlertSounds sounds;
    EXPECT_FALSE(sounds.isDue(incidents, choices));
    incidents.report(one); // the same incident
    EXPECT_FALSE(sounds.isDue(incidents, choices));
    one.sender = log::SenderId{1};
    incidents.report(one);
    EXPECT_TRUE(sounds.isDue(incidents, choices));
    EXPECT_FALSE(sounds.isDue(incidents, choices));
    one.kind = model::IncidentKind::Reordered; // a warning, which is silent
    incidents.report(one);
    EXPECT_FALSE(sounds.isDue(incidents, choices));
    choices = {};
    one.kind = model::IncidentKind::Local;
    one.sender = log::SenderId{2};
    incidents.report(one);
    EXPECT_FALSE(sounds.isDue(incidents, choices));
}

TEST(AlertSoundsTest, SoundWhereAWarningBecomesAnErrorAndForWhatIsSettledLate) {
    model::Incidents incidents;
    AlertChoices choices;
    choices.hasErrorSound = true;
    AlertSounds sounds;
    EXPECT_FALSE(sounds.isDue(incidents, choices));
    const std::uint64_t reserved = incidents.reserve(log::SenderId{1});
    incidents.report(model::Occurrence::at(model::IncidentKind::Restart, log::SenderId{1}, {}));
    EXPECT_FALSE(sounds.isDue(incidents, choices));
    model::Occurrence loss = model::Occurrence::at(model::IncidentKind::Loss, log::SenderId{1}, {});
    loss.samples = 1;
    EXPECT_EQ(incidents.report(loss), reserved);
    EXPECT_FALSE(sounds.isDue(incidents, choices)) << "a warning";
    loss.samples = 20;
    incidents.report(loss);
    EXPECT_TRUE(sounds.isDue(incidents, choices));
    incidents.report(loss);
    EXPECT_FALSE(sounds.isDue(incidents, choices));
}

TEST(BadTurnsTest, TellOnceForAnIncident) {
    using State = model::TakeVerdict::State;
    BadTurns turns;
    EXPECT_FALSE(turns.isDue({.state = State::Warning, .incident = 1}));
    EXPECT_TRUE(turns.isDue({.state = State::Bad, .incident = 1}));
    EXPECT_FALSE(turns.isDue({.state = State::Bad, .said = {words::Kind::NotGood}, .incident = 1}));
    EXPECT_TRUE(turns.isDue({.state = State::Bad, .incident = 2}));
    EXPECT_FALSE(turns.isDue({.state = State::Bad, .incident = 1})) << "again the worst of both";
    EXPECT_FALSE(turns.isDue({.state = State::Good}));
}

TEST(BadTurnsTest, PassOnNoMarkup) {
    const QString text = notificationText("Not good: no data from <b>Jonas</b> & co");
    EXPECT_FALSE(text.contains('<'));
    EXPECT_FALSE(text.contains('&'));
    EXPECT_TRUE(text.contains("Jonas"));
}

TEST(ThresholdRowsTest, ShowWhatIsChosenAndRestoreTheDefaults) {
    AlertChoices choices;
    choices.thresholds = {3, 20, 400, 2, 30, 10, 0.5};
    choices.hasWarningSound = true;
    const AlertChoices before = choices;
    int changes = 0;
    QWidget form;
    auto* rows = new QFormLayout(&form);
    addThresholdRows(*rows, choices, [&] { ++changes; });
    EXPECT_EQ(choices, before);
    std::vector<double> shown;
    for (const QDoubleSpinBox* box : form.findChildren<QDoubleSpinBox*>()) {
        EXPECT_FALSE(box->suffix().isEmpty());
        shown.push_back(box->value());
    }
    EXPECT_EQ(shown, (std::vector<double>{3, 20, 400, 2, 30, 10, 50}));
    EXPECT_TRUE(form.findChildren<QCheckBox*>().first()->isChecked());
    form.findChildren<QDoubleSpinBox*>().last()->setValue(60);
    EXPECT_EQ(choices.thresholds.hysteresis, 0.6);
    EXPECT_EQ(changes, 1);
    form.findChild<QPushButton*>()->click();
    EXPECT_EQ(choices, AlertChoices());
}

class HealthBarTest : public testing::Test {
protected:
    HealthBarTest() {
        m_bar.resize(1'400, 30);
        m_bar.show();
    }

    void perform(std::uint64_t from, std::uint64_t to, std::uint64_t lostFrom = 0, std::uint64_t lostTo = 0) {
        m_stage.perform(m_performer, from, to,
                        [=](std::uint64_t frame) { return frame < lostFrom || frame >= lostTo; });
        m_stage.follow();
        m_bar.refresh({});
    }
    [[nodiscard]] QWidget* open() {
        m_bar.resize(900, 30);
        m_bar.show();
        QTest::keyClick(m_bar.firstEntry(), Qt::Key_Space);
        return m_bar.findChild<QWidget*>("healthPopup");
    }

    Stage m_stage;
    performer::Performer m_performer{sending(1, {2}, 60.0)};
    HealthBar m_bar{m_stage.session, m_stage.commands};
};

TEST(HealthBarHistory, SaysHowFarBackItGoesAlsoOnceMemoryIsFull) {
    log::PacketLog log({.memoryCap = std::size_t{1280} << 10, .chunkSize = std::size_t{256} << 10});
    model::Session session(log);
    Commands commands(session);
    HealthBar bar(session, commands);
    const log::SenderId sender = log.senders().intern({Stage::kAddress, log::Transport::Udp, 9763});
    const std::vector<std::byte> bytes(700);
    log::Stamp now = Stage::kStart;
    for (int packet = 0; packet < 6'000; ++packet, now += 10ms) {
        log.writer().append(bytes, {now, sender, 0, {}});
        log.writer().publish();
        session.follow(now);
    }
    ASSERT_NE(session.begin(), 0U);
    bar.refresh({});
    QStringList texts;
    for (const auto* text : bar.findChildren<QLabel*>()) {
        texts += text->text();
    }
    const auto first = session.packet(session.begin());
    const QString back = duration(log::secondsOf(now - 10ms - first->stamp));
    EXPECT_FALSE(texts.filter("history " + back + " · ").isEmpty()) << texts.join("; ").toStdString();
    for (const auto* button : bar.findChildren<QAbstractButton*>()) {
        EXPECT_NE(button->focusPolicy(), Qt::NoFocus)
            << "called a button, but nothing presses it: " << button->text().toStdString();
    }
}

TEST_F(HealthBarTest, SaysWhyAndEachLineLeadsToItsPackets) {
    perform(0, 240, 60, 63);
    const QWidget* popup = open();
    ASSERT_NE(popup, nullptr);
    EXPECT_EQ(m_stage.session.choices().selection.character, m_stage.key());
    const auto lines = popup->findChildren<QAbstractButton*>("trouble");
    ASSERT_FALSE(lines.empty());
    EXPECT_TRUE(lines.first()->text().contains(QStringLiteral("lost"), Qt::CaseInsensitive))
        << lines.first()->text().toStdString();
    QTest::keyClick(lines.first(), Qt::Key_Space);
    ASSERT_TRUE(m_stage.session.choices().selection.packet.has_value());
    EXPECT_EQ(m_stage.session.accounts().digests().find(*m_stage.session.choices().selection.packet)->gap,
              3U);
    EXPECT_EQ(m_stage.session.choices().displayFilter, "") << "in their context";
    EXPECT_FALSE(popup->isVisible());
}

TEST_F(HealthBarTest, SaysWhatIsOfNowWhileARecordingIsShown) {
    perform(0, 120);
    const auto* label = m_bar.findChild<QLabel*>("ofNow");
    EXPECT_TRUE(label->isHidden());
    m_stage.session.endFile();
    m_bar.refresh({});
    EXPECT_FALSE(label->isHidden());
}

TEST_F(HealthBarTest, SaysThatAllCameWhereItIsGood) {
    perform(0, 240);
    EXPECT_EQ(lossText(m_stage.session, m_stage.key()),
              QStringLiteral("All 240 samples arrived · now, last 10 s"));
    const QWidget* popup = open();
    ASSERT_NE(popup, nullptr);
    EXPECT_TRUE(popup->findChildren<QAbstractButton*>("trouble").empty());
    popup->findChild<QPushButton*>(QStringLiteral("frameCharacter"))->click();
    EXPECT_EQ(m_stage.asked.framed.size(), 1U);
}

TEST_F(HealthBarTest, ShowsTheWorstFirstAndAllInAList) {
    performer::Performer twenty(sending(20, {2}, 60.0));
    for (std::uint64_t frame = 0; frame < 240; ++frame) {
        for (const wire::Datagram& datagram : twenty.frame(frame)) {
            if (datagram.header.character != 17 || frame % 10 != 0) {
                m_stage.send(datagram, Stage::kStart + log::durationOf(static_cast<double>(frame) / 60));
            }
        }
    }
    m_stage.follow();
    m_bar.resize(1'480, 30); // "Now" takes some of it
    m_bar.show();
    m_bar.refresh({});
    const int width = m_bar.firstEntry()->width();
    QTest::keyClick(m_bar.firstEntry(), Qt::Key_Space);
    EXPECT_EQ(m_stage.session.choices().selection.character, m_stage.key(17));
    m_bar.findChild<QWidget*>("healthPopup")->close();
    auto* more = m_bar.findChild<QAbstractButton*>("more");
    ASSERT_TRUE(more->isVisible());
    QTest::keyClick(more, Qt::Key_Space);
    auto* list = m_bar.findChild<QWidget*>("healthList");
    ASSERT_NE(list, nullptr);
    auto* table = list->findChild<QAbstractItemView*>();
    ASSERT_EQ(table->model()->rowCount(), 20);
    emit table->clicked(table->model()->index(19, 0));
    EXPECT_EQ(m_stage.session.choices().selection.character, m_stage.key(19));
    m_stage.now += 3s; // other, longer words
    m_stage.follow();
    m_bar.refresh({});
    const int wider = m_bar.firstEntry()->width();
    EXPECT_GE(wider, width);
    perform(420, 480); // and shorter ones again
    EXPECT_GE(m_bar.firstEntry()->width(), wider);
}

TEST_F(HealthBarTest, AMessageHasAllTheRoomWhileThereIsNobodyToShow) {
    m_bar.resize(1'200, 30);
    m_bar.show();
    const QString text(90, u'm');
    m_bar.say(text);
    m_bar.refresh({});
    QTest::qWait(1);
    const auto* message = m_bar.findChild<QLabel*>("message");
    EXPECT_GT(message->width(), 500);
    perform(0, 60);
    m_bar.refresh({});
    QTest::qWait(1);
    EXPECT_GT(m_bar.firstEntry()->width(), 0);
    EXPECT_LT(message->width(), 500) << "shared with the characters";
}

TEST_F(HealthBarTest, ANarrowBarCountsTheCharactersAndNothingOverlaps) {
    perform(0, 60);
    m_bar.resize(180, 30);
    m_bar.show();
    m_bar.refresh({});
    auto* more = m_bar.findChild<QAbstractButton*>("more");
    EXPECT_EQ(m_bar.firstEntry(), more);
    EXPECT_TRUE(more->text().contains("1 character")) << more->text().toStdString();
}

TEST_F(HealthBarTest, SaysTheSameAsTheVerdictAlsoWhilePaused) {
    perform(0, 240);
    m_stage.session.setCursor({model::Cursor::Mode::Paused, 60});
    m_stage.now += 3s;
    m_stage.follow();
    m_bar.refresh({});
    const auto* entry = qobject_cast<QAbstractButton*>(m_bar.firstEntry());
    EXPECT_TRUE(entry->text().contains(QStringLiteral("no data for 3"))) << entry->text().toStdString();
}

TEST_F(HealthBarTest, CountsWhatWasLost) {
    perform(0, 240, 60, 63);
    EXPECT_EQ(lossText(m_stage.session, m_stage.key()),
              QStringLiteral("Lost 3 of 240 samples · now, last 10 s"));
}

TEST(ReportSavingTest, WritesAPageOrSaysWhyNot) {
    Stage stage;
    performer::Performer performer(sending(1, {2}, 60.0));
    stage.perform(performer, 0, 120);
    stage.follow();
    const QTemporaryDir folder;
    EXPECT_EQ(writeStreamReport(stage.session, std::nullopt, folder.filePath("report.html")), QString());
    QFile page(folder.filePath("report.html"));
    ASSERT_TRUE(page.open(QIODevice::ReadOnly));
    const QByteArray text = page.readAll();
    EXPECT_TRUE(text.startsWith("<!DOCTYPE html>") || text.startsWith("<!doctype html>"));
    EXPECT_TRUE(text.trimmed().endsWith("</html>"));
    EXPECT_TRUE(writeStreamReport(stage.session, model::TimeRange{Stage::kStart, stage.now},
                                  folder.filePath("none/report.html"))
                    .contains("cannot be written"));
}

TEST(HealthBarRoom, FourCharactersInTroubleAreWholeAndOnlyNamesAreCut) {
    Stage stage;
    performer::Performer four(sending(4, {2, 12}, 60.0));
    stage.perform(four, 0, 240, [](std::uint64_t frame) { return frame % 60 != 30; });
    stage.follow();
    HealthBar bar(stage.session, stage.commands);
    bar.show();
    for (const int width : {980, 1'280, 1'900}) {
        bar.resize(width, 30);
        bar.refresh({});
        QTest::qWait(1);
        bar.refresh({});
        int shown = 0;
        int end = 0;
        for (const auto* entry : bar.findChildren<ColourText*>()) {
            const bool isOfCharacter = entry->isVisible() && entry->text().contains("lost");
            shown += isOfCharacter ? 1 : 0;
            if (isOfCharacter) {
                const int margin = entry->fontMetrics().height() / 4 + 1;
                EXPECT_LE(entry->fontMetrics().horizontalAdvance(entry->text()), entry->width() - 2 * margin)
                    << width << " " << entry->text().toStdString();
                EXPECT_GE(entry->x(), end) << width;
                const int idle = entry->width() - 2 * margin -
                                 entry->fontMetrics().horizontalAdvance(entry->text() + u'M');
                EXPECT_TRUE(idle < 0 || !entry->text().contains(u'…'))
                    << "cut beside " << idle << " idle pixels: " << entry->text().toStdString();
                EXPECT_FALSE(width > 1'280 && entry->text().contains(u'…')) << entry->text().toStdString();
                end = entry->geometry().right();
            }
        }
        EXPECT_EQ(shown, width >= 1'280 ? 4 : shown) << width;
        EXPECT_GE(shown, 1) << width;
    }
}

} // namespace

} // namespace posewire::gui
