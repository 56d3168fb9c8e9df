// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/viewport_widget.h"

#include "app/gui/viewport/segment_card.h"
#include "app/gui/viewport/viewport_overlay.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "render/offscreen.h"
#include "tests/app/gui/models/stage.h"

#include <QApplication>
#include <QJsonArray>
#include <QMenu>
#include <QMouseEvent>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

class Viewport : public testing::Test {
protected:
    void SetUp() override {
        if (!render::OffscreenRenderer::create()) {
            GTEST_SKIP() << "SKIPPED: no OpenGL by EGL on this computer";
        }
        performer::Performer performer(sending(1, {2, 12, 13}));
        stage.perform(performer, 0, 3);
        stage.follow();
        viewport.resize(480, 360);
        viewport.show();
        viewport.pictures().start();
        ASSERT_TRUE(settle());
    }
    bool settle() {
        return QTest::qWaitFor(
                   [this] {
                       return viewport.pictures().isSettled() || !viewport.pictures().failure().isEmpty();
                   },
                   20'000) &&
               viewport.pictures().failure().isEmpty();
    }

    /// Pixels near a colour's hue, bright or in shadow.
    static int countHue(const QImage& image, const QColor& colour) {
        int count = 0;
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                const QColor pixel = image.pixelColor(x, y);
                const int distance = std::abs(pixel.hue() - colour.hue());
                count +=
                    pixel.saturation() > 110 && pixel.value() > 60 && std::min(distance, 360 - distance) < 12
                        ? 1
                        : 0;
            }
        }
        return count;
    }
    /// The middle of the first figure on the widget, where a click meets it.
    QPoint middleOfFigure() {
        const QPointF label = viewport.overlay().labels().at(0).anchor;
        return {static_cast<int>(label.x()), viewport.height() / 2};
    }

    void restOn(const QPoint& place) {
        QMouseEvent move(QEvent::MouseMove, place, viewport.mapToGlobal(QPointF(place)), Qt::NoButton,
                         Qt::NoButton, Qt::NoModifier);
        QApplication::sendEvent(&viewport, &move);
    }

    Stage stage;
    ViewportWidget viewport{stage.session, stage.commands};
    QMenu menu; ///< stands for those of the window
};

TEST_F(Viewport, PaintsACharacterInItsColourWithoutADisplay) {
    const model::Colour colour = stage.session.roster().colour(stage.key());
    const QImage image = viewport.grab().toImage();
    EXPECT_GT(countHue(image, QColor::fromRgbF(colour.red, colour.green, colour.blue)), 1500);
}

TEST_F(Viewport, NamesEveryCharacterInThePicture) {
    ASSERT_EQ(viewport.overlay().labels().size(), 1U);
    EXPECT_EQ(viewport.overlay().labels()[0].name.toStdString(),
              stage.session.roster().displayName(stage.key()).shown());
    EXPECT_EQ(viewport.overlay().labels()[0].state.health, Health::Good);
    EXPECT_TRUE(viewport.overlay().card().title.isEmpty());
}

TEST_F(Viewport, LabelsStaleDataAsStale) {
    stage.session.follow(stage.now + 3s);
    viewport.refresh();
    EXPECT_TRUE(
        QTest::qWaitFor([this] { return viewport.overlay().labels().at(0).state.health == Health::Error; }));
    EXPECT_TRUE(viewport.overlay().labels()[0].state.text.contains("no data for 3"));
}

TEST_F(Viewport, HidesACharacterOnRequest) {
    stage.session.setHidden(stage.key(), true);
    viewport.refresh();
    EXPECT_TRUE(QTest::qWaitFor([this] { return viewport.overlay().labels().empty(); }));
}

TEST_F(Viewport, AClickOnTheBodySelectsASegmentAndBesideItNothing) {
    QTest::mouseClick(&viewport, Qt::LeftButton, {}, middleOfFigure());
    ASSERT_TRUE(stage.session.choices().selection.character.has_value());
    EXPECT_EQ(*stage.session.choices().selection.character, stage.key());
    EXPECT_GE(stage.session.choices().selection.segment, 0);
    QTest::mouseClick(&viewport, Qt::LeftButton, {}, QPoint(5, viewport.height() - 5));
    EXPECT_FALSE(stage.session.choices().selection.character.has_value());
}

TEST_F(Viewport, ADragTurnsTheCameraAndSelectsNothing) {
    const QImage before = viewport.grab().toImage();
    const QPoint middle = middleOfFigure();
    QTest::mousePress(&viewport, Qt::LeftButton, {}, middle);
    QTest::mouseMove(&viewport, middle + QPoint(80, 10));
    QTest::mouseRelease(&viewport, Qt::LeftButton, {}, middle + QPoint(80, 10));
    EXPECT_EQ(stage.asked.count, 0);
    EXPECT_TRUE(QTest::qWaitFor([&] { return viewport.grab().toImage() != before; }));
}

TEST_F(Viewport, ShowsTheValuesOfWhatThePointerRestsOn) {
    const auto* card = viewport.findChild<SegmentCard*>();
    ASSERT_NE(card, nullptr);
    viewport.resize(900, 700);
    ASSERT_TRUE(
        QTest::qWaitFor([this] { return viewport.overlay().labels().at(0).anchor.x() > 400; }, 20'000));
    restOn(middleOfFigure());
    EXPECT_TRUE(QTest::qWaitFor([&] { return card->facts().has_value(); }, 20'000));
    restOn(QPoint(5, viewport.height() - 5));
    EXPECT_TRUE(QTest::qWaitFor([&] { return !card->facts().has_value(); }, 20'000));
    stage.session.setSelection({stage.sender(), stage.key(), model::segment::kHead});
    viewport.refresh();
    EXPECT_TRUE(QTest::qWaitFor([&] { return card->facts() && card->facts()->segment == "Head"; }, 20'000));
}

TEST_F(Viewport, AClickShowsTheValuesOfWhatIsClicked) {
    const auto* card = viewport.findChild<SegmentCard*>();
    viewport.resize(900, 700);
    ASSERT_TRUE(
        QTest::qWaitFor([this] { return viewport.overlay().labels().at(0).anchor.x() > 400; }, 20'000));
    restOn(middleOfFigure());
    ASSERT_TRUE(QTest::qWaitFor([&] { return card->facts().has_value(); }));
    // As where somebody walks on under a pointer that rests.
    const QPoint head = viewport.overlay().labels()[0].head.center().toPoint();
    QTest::mouseClick(&viewport, Qt::LeftButton, {}, head);
    ASSERT_TRUE(card->facts().has_value());
    EXPECT_EQ(card->facts()->segment, "Head");
    QTest::mouseClick(&viewport, Qt::LeftButton, {}, QPoint(5, viewport.height() - 5));
    EXPECT_FALSE(card->facts().has_value());
}

QJsonObject cameraOf(const ViewportWidget& viewport) {
    return viewport.choice().state()["panes"].toObject()["cameras"].toArray().at(0).toObject();
}

TEST_F(Viewport, KeepsViewsFromOneRunToTheNext) {
    viewport.face(render::StandardView::Top);
    const QJsonObject top = cameraOf(viewport);
    viewport.choice().keepView(2);
    viewport.face(render::StandardView::Front);
    ViewportWidget other(stage.session, stage.commands);
    other.choice().restoreState(viewport.choice().state());
    EXPECT_FALSE(other.choice().isKept(0));
    EXPECT_NE(cameraOf(other), top);
    other.choice().showKeptView(2);
    EXPECT_EQ(cameraOf(other), top);
}

TEST_F(Viewport, FacesThePelvisOrTheWorld) {
    const Eigen::Vector3d ahead =
        stage.session.messages().pose(stage.key())->segments[0].orientation * Eigen::Vector3d::UnitX();
    const double heading = std::atan2(ahead.y(), ahead.x());
    const auto yaw = [this] { return cameraOf(viewport)["yaw"].toDouble(); };
    viewport.face(render::StandardView::Front);
    EXPECT_NEAR(yaw(), heading, 1e-4);
    viewport.choice().toggleSwitch(ViewSwitch::RelativeViews);
    viewport.face(render::StandardView::Front);
    EXPECT_EQ(yaw(), 0);
}

TEST_F(Viewport, TheKeyboardMovesTheCameraAsTheMouseDoes) {
    viewport.face(render::StandardView::Front);
    const auto now = [this] { return cameraOf(viewport); };
    const QJsonObject front = now();
    viewport.choice().orbitBy(1, 0);
    EXPECT_NE(now()["yaw"], front["yaw"]);
    viewport.choice().orbitBy(-1, 1);
    EXPECT_NEAR(now()["yaw"].toDouble(), front["yaw"].toDouble(), 1e-5);
    EXPECT_GT(now()["pitch"].toDouble(), front["pitch"].toDouble()) << "from above";
    viewport.choice().orbitBy(0, -1);
    EXPECT_TRUE(now()["following"].toBool());
    viewport.choice().zoomBy(2);
    const QJsonObject close = now();
    viewport.choice().zoomBy(2);
    EXPECT_LT(now()["distance"].toDouble(), close["distance"].toDouble());
    const QJsonArray before = now()["target"].toArray();
    viewport.choice().panBy(0, 1);
    EXPECT_GT(now()["target"].toArray().at(2).toDouble(), before.at(2).toDouble());
    EXPECT_FALSE(now()["following"].toBool());
}

TEST_F(Viewport, FramesACharacterAsItWasBeforeARestart) {
    performer::Performer performer(sending(1, {2, 12, 13}));
    const std::string after = "192.168.10.21:52012";
    stage.perform(performer, 3, 120);
    for (std::uint64_t frame = 0; frame < 30; ++frame) {
        for (const wire::Datagram& datagram : performer.frame(frame)) {
            stage.send(datagram, Stage::kStart + 10s + log::durationOf(static_cast<double>(frame) / 240),
                       after);
        }
    }
    stage.follow();
    const model::CharacterKey now = stage.session.roster().current(stage.key());
    ASSERT_NE(now, stage.key());
    const std::uint64_t before = stage.session.packetAt(Stage::kStart + 100ms);
    stage.session.setCursor({model::Cursor::Mode::Paused, before});
    viewport.refresh();
    ASSERT_TRUE(settle());
    EXPECT_EQ(viewport.overlay().labels().size(), 1U) << "it is not there twice";
    viewport.frameCharacter(now);
    EXPECT_FALSE(cameraOf(viewport)["following"].toBool());
}

TEST_F(Viewport, ShowsTheBodyWhereverAPausedMomentHasIt) {
    performer::Performer performer(sending(1, {2, 12, 13}));
    stage.perform(performer, 3, 1'200);
    stage.follow();
    const std::uint64_t end = stage.session.end();
    for (const std::uint64_t packet : {end / 2, end - 1, end / 4, std::uint64_t{20}}) {
        stage.session.setCursor({model::Cursor::Mode::Paused, packet});
        viewport.refresh();
        ASSERT_TRUE(settle());
        ASSERT_EQ(viewport.overlay().labels().size(), 1U);
        const double x = viewport.overlay().labels().front().anchor.x();
        EXPECT_NEAR(x, viewport.width() / 2.0, 0.4 * viewport.width()) << packet;
    }
}

TEST_F(Viewport, FollowsWhileARecordingPlays) {
    performer::Performer performer(sending(1, {2, 12, 13}));
    stage.perform(performer, 3, 1'200);
    stage.follow(); // its time stands still from here on, as that of a file does
    model::Cursor cursor{model::Cursor::Mode::Paused, 20};
    cursor.speed = 1;
    for (std::uint64_t packet = 20; packet < stage.session.end(); packet += 24) {
        cursor.packet = packet;
        stage.session.setCursor(cursor);
        viewport.refresh();
        ASSERT_TRUE(settle());
    }
    ASSERT_EQ(viewport.overlay().labels().size(), 1U);
    const double x = viewport.overlay().labels().front().anchor.x();
    EXPECT_NEAR(x, viewport.width() / 2.0, 0.4 * viewport.width());
}

TEST_F(Viewport, TheCameraFinishesItsWayWhilePaused) {
    stage.session.setCursor({model::Cursor::Mode::Paused, stage.session.end() - 1});
    viewport.refresh();
    ASSERT_TRUE(settle());
    viewport.face(render::StandardView::Top); // from there a body is smaller
    EXPECT_TRUE(viewport.choice().look().isGliding());
    EXPECT_TRUE(QTest::qWaitFor(
        [this] {
            stage.session.follow(stage.now += 20ms);
            return !viewport.choice().look().isGliding();
        },
        20'000));
}

TEST_F(Viewport, TwoViewsOfOneSessionDrawAtOnce) {
    ViewportWidget other(stage.session, stage.commands);
    other.resize(320, 240);
    other.show();
    other.pictures().start();
    EXPECT_TRUE(QTest::qWaitFor([&] { return other.pictures().count() > 0; }, 20'000));
    const std::uint64_t before = viewport.pictures().count();
    stage.session.setHidden(stage.key(), true);
    viewport.refresh();
    EXPECT_TRUE(QTest::qWaitFor([&] { return viewport.pictures().count() > before; }, 20'000));
    EXPECT_TRUE(other.pictures().failure().isEmpty());
}

TEST_F(Viewport, SaysWhenItsPictureIsOfAnotherSizeThanTheView) {
    const std::unique_ptr<Presenter> presenter(makeSoftwarePresenter(nullptr));
    presenter->resize(200, 100);
    const QSignalSpy outgrown(presenter.get(), &Presenter::outgrown);
    const auto show = [&](int width, int height) {
        QSignalSpy presented(presenter.get(), &Presenter::presented);
        auto frame = std::make_shared<SceneFrame>();
        frame->width = width; // as for a screen of another scale, or after a resize
        frame->height = height;
        presenter->present(std::move(frame));
        ASSERT_TRUE(presented.wait(20'000));
        presenter->grab();
        QCoreApplication::processEvents();
    };
    show(400, 200);
    EXPECT_GT(outgrown.count(), 0);
    const auto before = outgrown.count();
    show(200, 100);
    EXPECT_EQ(outgrown.count(), before);
}

/// Graphics hardware that is there and fails with the first picture.
class FailingHardware final : public Presenter {
public:
    using Presenter::Presenter;
    [[nodiscard]] bool isReady() const override { return m_failure.isEmpty(); }
    void present(std::shared_ptr<const SceneFrame> /*frame*/) override {
        m_failure = QStringLiteral("The graphics driver was reset.");
        QMetaObject::invokeMethod(this, &Presenter::presented, Qt::QueuedConnection);
    }
    [[nodiscard]] QString rendererName() const override { return QStringLiteral("broken"); }
    [[nodiscard]] QString failure() const override { return m_failure; }
    [[nodiscard]] PictureLoad load() const override { return {}; }
    [[nodiscard]] std::uint64_t pictures() const override { return 0; }

private:
    QString m_failure;
};

TEST_F(Viewport, LeavesDrawingToTheProcessorWhereTheHardwareFails) {
    ViewportWidget other(stage.session, stage.commands);
    other.resize(320, 240);
    other.show();
    other.pictures().start([](QWidget* parent) -> Presenter* { return new FailingHardware(parent); });
    EXPECT_TRUE(QTest::qWaitFor([&] { return other.pictures().count() > 0; }, 20'000));
    EXPECT_TRUE(other.pictures().failure().isEmpty());
    EXPECT_NE(other.pictures().rendererName(), QStringLiteral("broken"));
    EXPECT_TRUE(other.pictures().health().why.contains("The graphics driver was reset."))
        << other.pictures().health().why.toStdString();
}

TEST(ViewportLabels, ShowHowACharacterDoesHoweverLongItsName) {
    QWidget window;
    window.resize(480, 360);
    ViewportOverlay overlay(&window);
    overlay.resize(window.size());
    ViewportLabel label;
    label.anchor = QPointF(240, 180);
    label.name = QString(60'000, QLatin1Char('W'));
    label.state = {QStringLiteral("stale"), Health::Error};
    overlay.setLabels({label});
    const QImage image = overlay.grab().toImage();
    const QColor wanted = healthColour(Health::Error);
    int found = 0;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const QColor pixel = image.pixelColor(x, y);
            found += std::abs(pixel.red() - wanted.red()) < 40 &&
                             std::abs(pixel.green() - wanted.green()) < 40 &&
                             std::abs(pixel.blue() - wanted.blue()) < 40
                         ? 1
                         : 0;
        }
    }
    EXPECT_GT(found, 10);
}

TEST_F(Viewport, ButtonsWithoutRoomAreInAMenu) {
    addViewportButtons(viewport, menu, menu);
    auto* buttons = viewport.findChild<QWidget*>("viewportButtons");
    ASSERT_NE(buttons, nullptr);
    buttons->show();
    const auto shown = [&] {
        int count = 0;
        for (const QToolButton* one : buttons->findChildren<QToolButton*>()) {
            count += one->isVisible() ? 1 : 0;
            EXPECT_TRUE(!one->isVisible() ||
                        viewport.rect().contains(QRect(one->mapTo(&viewport, QPoint(0, 0)), one->size())))
                << one->text().toStdString() << " at " << viewport.width();
        }
        return count;
    };
    viewport.resize(900, 400);
    QTest::qWait(1);
    EXPECT_EQ(shown(), 4);
    for (const int width : {420, 300, 220}) {
        viewport.resize(width, 400);
        QTest::qWait(1);
        EXPECT_LE(shown(), 4);
        const auto* more = buttons->findChild<QToolButton*>("moreOfViewport");
        ASSERT_NE(more, nullptr);
        EXPECT_TRUE(more->isVisible()) << width;
    }
}

TEST_F(Viewport, LabelsStandAboveHeadsRightBelowTheButtons) {
    addViewportButtons(viewport, menu, menu);
    auto* buttons = viewport.findChild<QWidget*>("viewportButtons");
    ASSERT_NE(buttons, nullptr);
    buttons->show();
    QTest::qWait(1);
    ViewportOverlay overlay(&viewport);
    overlay.setGeometry(viewport.rect());
    overlay.show();
    ViewportLabel label;
    label.name = QStringLiteral("Mira");
    const int plate = overlay.fontMetrics().height() + 8;
    const int below = buttons->y() + buttons->childrenRect().bottom();
    label.anchor = QPointF(150, below + plate + 9);
    label.head = QRectF(130, label.anchor.y() + 4, 40, 50);
    label.depth = 4;
    overlay.setLabels({label});
    overlay.grab();
    ASSERT_EQ(overlay.placed().size(), 1U);
    const QRectF placed = overlay.placed().front().plate;
    EXPECT_EQ(overlay.placed().front().form, LabelForm::Whole);
    EXPECT_LE(placed.bottom(), label.head.top()) << "above it, not beside it";
    EXPECT_GT(placed.top(), below);
}

} // namespace
} // namespace posewire::gui
