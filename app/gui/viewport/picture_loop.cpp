// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/picture_loop.h"

#include "app/gui/base/logging.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"

#include <QStringList>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace posewire::gui {

PictureLoop::PictureLoop(model::SessionView& session, ViewLook& look, QWidget* view)
    : QObject(view), m_session(&session), m_look(look), m_view(*view) {
    constexpr int kGlide = 12; // milliseconds: faster than displays would show it
    m_glideTimer.setSingleShot(true);
    m_glideTimer.setInterval(kGlide);
    connect(&m_glideTimer, &QTimer::timeout, this, &PictureLoop::refresh);
}

void PictureLoop::start(Presenter* (*makeHardware)(QWidget*)) {
    if (m_presenter != nullptr) {
        return;
    }
    Presenter* hardware = makeHardware(&m_view);
    m_isHardware = hardware != nullptr;
    qCInfo(drawingLog) << (m_isHardware ? "into the window, by graphics hardware"
                                        : "on a thread, by the processor or without the window's OpenGL");
    use(m_isHardware ? hardware : makeSoftwarePresenter(&m_view));
}

void PictureLoop::use(Presenter* presenter) {
    m_presenter = presenter;
    m_builder = makeBuilder();
    m_presenter->setAttribute(Qt::WA_TransparentForMouseEvents);
    m_presenter->lower();
    m_presenter->setVisible(true);
    connect(m_presenter, &Presenter::presented, this, &PictureLoop::onPresented);
    connect(m_presenter, &Presenter::ready, this, [this] {
        emit due();
        drawNext();
    });
    connect(m_presenter, &Presenter::outgrown, this, &PictureLoop::refresh);
    refresh();
}

/// The processor draws if the hardware fails, at once or later by a reset of its driver.
void PictureLoop::leaveHardware() {
    m_hardwareFailure = m_presenter->failure();
    qCWarning(drawingLog).noquote() << "graphics hardware failed, the processor draws:" << m_hardwareFailure;
    disconnect(m_presenter, nullptr, this, nullptr);
    m_presenter->setVisible(false);
    m_presenter->deleteLater();
    m_isHardware = false;
    m_drawing.reset();
    use(makeSoftwarePresenter(&m_view));
}

std::unique_ptr<SceneBuilder> PictureLoop::makeBuilder() const {
    return std::make_unique<SceneBuilder>(*m_session,
                                          m_isHardware ? render::Detail::High : render::Detail::Medium);
}

void PictureLoop::showSession(model::SessionView& session) {
    m_session = &session;
    m_shown.reset(); // its figures are of the other session
    m_drawing.reset();
    m_followed = {};
    if (m_builder != nullptr) {
        m_builder = makeBuilder();
    }
    refresh();
}

void PictureLoop::setComparison(const ComparisonState& comparison) {
    m_comparison = &comparison;
    refresh();
}

void PictureLoop::refresh() {
    m_isOutdated = true;
    m_look.panes.resize(m_view.size());
    if (m_presenter != nullptr) {
        m_presenter->setGeometry(m_view.rect());
    }
    drawNext();
}

void PictureLoop::drawNext() {
    if (!m_isOutdated || m_presenter == nullptr || !m_presenter->isReady() || !m_view.isVisible()) {
        return;
    }
    auto frame = std::make_shared<SceneFrame>();
    frame->pixelRatio = static_cast<float>(m_view.devicePixelRatioF());
    frame->width = std::max(1, qRound(m_view.width() * m_view.devicePixelRatioF()));
    frame->height = std::max(1, qRound(m_view.height() * m_view.devicePixelRatioF()));
    m_builder->setInterpolating(m_isInterpolating);
    m_builder->setComparison(m_comparison);
    // Between two moments at rest no pictures come in which the camera could glide.
    const model::Cursor& cursor = m_session->choices().cursor;
    const bool isAtRest = cursor.mode == model::Cursor::Mode::Paused && cursor.speed == 0;
    const bool isElsewhere = isAtRest && cursor.packet != m_followedPacket;
    // A recording that plays stays as it is: there the cursor tells how time goes by.
    const log::Stamp moment = m_session->cursorStamp();
    const log::Duration played =
        moment > m_followedMoment ? moment - m_followedMoment : m_followedMoment - moment;
    const double seconds = isElsewhere ? std::numeric_limits<double>::infinity()
                                       : log::secondsOf(std::max(m_session->now() - m_followed, played));
    m_followedPacket = cursor.packet;
    m_followedMoment = moment;
    if (m_look.panes.isSplit()) {
        m_look.fillPanes(*m_builder, seconds, *frame);
    } else {
        m_look.fill(*m_builder, seconds, *frame);
    }
    m_followed = m_session->now();
    m_drawingBuilt = m_session->now();
    m_isOutdated = false;
    if (m_builder->isUnderWay() || (isAtRest && m_look.isGliding())) {
        m_glideTimer.start();
    }
    m_drawing = frame;
    m_presenter->present(std::move(frame));
}

void PictureLoop::onPresented() {
    if (m_isHardware && !m_presenter->failure().isEmpty()) {
        leaveHardware();
        return;
    }
    if (!std::exchange(m_hasPicture, true)) {
        qCInfo(drawingLog).noquote() << "first picture by" << m_presenter->rendererName();
    }
    if (m_drawing != nullptr) {
        m_shown = std::exchange(m_drawing, nullptr);
        m_shownBuilt = m_drawingBuilt;
    }
    emit presented();
    drawNext();
}

PictureHealth PictureLoop::health() const {
    return m_hasPicture ? pictureHealthOf(m_presenter->load(), m_hardwareFailure) : PictureHealth{};
}

bool PictureLoop::isSettled() const {
    constexpr log::Duration kFresh = std::chrono::milliseconds(250);
    const bool isIdle = !m_isOutdated && m_drawing == nullptr;
    // A moment that is held has to be shown itself.
    const bool isStreaming =
        !m_session->isRecording() && m_session->choices().cursor.mode == model::Cursor::Mode::Following;
    return m_shown != nullptr && (isIdle || (isStreaming && m_session->now() - m_shownBuilt < kFresh));
}

namespace {

using render::Simplification;

/// Seconds a picture; where they take longer, movement is not seen as one.
constexpr double kSlow = 0.1;

/// Beside what the steps before it leave out.
QString leftOut(Simplification step) {
    const std::array words{tr("full quality"),  tr("coarse shadows"), tr("small shadows"),
                           tr("coarse bodies"), tr("hard shadows"),   tr("raw edges"),
                           tr("fewer axes"),    tr("half rate")}; // by Simplification
    return words[static_cast<std::size_t>(step)];
}

QString milliseconds(double seconds) {
    return fixed(seconds * 1000, 0);
}

} // namespace

PictureHealth pictureHealthOf(const PictureLoad& load, const QString& hardwareFailure) {
    if (load.budget <= 0) {
        return {tr("by graphics hardware"), tr("The graphics hardware draws; nothing is left out."), false};
    }
    const auto step = static_cast<int>(load.step);
    QString why = hardwareFailure.isEmpty()
                      ? tr("The processor draws the viewport, since there is no graphics hardware for it.")
                      : tr("The processor draws the viewport, since the graphics hardware failed: %1")
                            .arg(hardwareFailure);
    why += QLatin1Char('\n') +
           tr("A picture may take %1 ms, so that receiving and the window have time. Where it takes longer, "
              "what is missed least is left out, step by step, and comes back when there is time. A picture "
              "in which nothing moves is always drawn in full.")
               .arg(milliseconds(load.budget));
    if (step != 0) {
        QStringList all;
        for (int one = 1; one <= step; ++one) {
            all += leftOut(static_cast<Simplification>(one));
        }
        why += QLatin1Char('\n') + tr("Now on step %1 of %2, since a picture took %3 ms: %4.")
                                       .arg(step)
                                       .arg(render::kLastSimplification)
                                       .arg(milliseconds(load.cause), all.join(QStringLiteral(", ")));
    }
    if (load.isStill) {
        return {tr("nothing moves · full quality"), why, false};
    }
    const QString state =
        step == 0
            ? leftOut(load.step)
            : tr("step %1 of %2: %3").arg(step).arg(render::kLastSimplification).arg(leftOut(load.step));
    return {load.typical > 0 ? tr("%1 · %2 ms").arg(state, milliseconds(load.typical)) : state, why,
            load.step >= Simplification::FewAxes || load.typical > kSlow};
}

} // namespace posewire::gui
