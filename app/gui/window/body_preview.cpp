// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/body_preview.h"

#include "app/gui/theme/theme.h"

#include <QKeyEvent>
#include <QMouseEvent>

#include <algorithm>
#include <utility>

namespace posewire::gui {

namespace {

/// The mannequin's palette in the T-pose, each hand as flat as in the scale message.
std::array<render::DualQuaternion, render::kJointCount> tPose() {
    std::array<glm::vec3, render::kSegmentCount> positions = render::kReferenceNullPose;
    std::array<glm::quat, render::kSegmentCount> turns{};
    turns.fill(glm::quat(1, 0, 0, 0));
    std::array<glm::vec3, render::kFingerJointCount> fingers{};
    std::array<glm::quat, render::kFingerJointCount> fingerTurns{};
    fingerTurns.fill(glm::quat(1, 0, 0, 0));
    for (std::size_t i = 0; i < fingers.size(); ++i) {
        fingers[i] = render::jointOrigin(render::kFirstFingerJoint + i);
    }
    constexpr std::size_t kHand = render::kHandSegmentCount;
    std::array<render::DualQuaternion, render::kJointCount> palette{};
    const render::PaletteJob job{positions,
                                 turns,
                                 render::kReferenceNullPose,
                                 palette,
                                 {std::span(fingers).first(kHand), std::span(fingerTurns).first(kHand)},
                                 {std::span(fingers).last(kHand), std::span(fingerTurns).last(kHand)},
                                 fingers};
    job.run();
    return palette;
}

} // namespace

BodyPreview::BodyPreview(QWidget* parent) : QWidget(parent), m_presenter(makeSoftwarePresenter(this)) {
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("The character in the T-pose; arrow keys turn it"));
    setMinimumSize(fontMetrics().averageCharWidth() * 36, fontMetrics().height() * 18);
    m_presenter->setAttribute(Qt::WA_TransparentForMouseEvents);
    connect(m_presenter, &Presenter::presented, this, [this] {
        if (std::exchange(m_isWaiting, false)) {
            draw();
        }
    });
    connect(m_presenter, &Presenter::ready, this, &BodyPreview::draw);
    connect(m_presenter, &Presenter::outgrown, this, &BodyPreview::draw);
    constexpr float kAside = 0.45F;
    m_motion.turn(kAside);
}

QSize BodyPreview::sizeHint() const {
    return {fontMetrics().averageCharWidth() * 52, fontMetrics().height() * 26};
}

void BodyPreview::setBody(std::shared_ptr<const DressedBody> body) {
    m_figure = {};
    if (body != nullptr) {
        m_figure.palette = tPose();
        m_figure.own = sized(std::move(body), 1.0F);
        const render::OwnBody& own = m_figure.own->dressed->body;
        m_figure.bones.resize(own.joints.size());
        render::OwnPaletteJob{&own, 1.0F, m_figure.palette, render::kReferenceNullPose, m_figure.bones}.run();
        const QColor colour = theme().accent;
        m_figure.look.colour = {static_cast<float>(colour.redF()), static_cast<float>(colour.greenF()),
                                static_cast<float>(colour.blueF())};
    }
    render::Bounds box;
    for (std::size_t i = 0; m_figure.own != nullptr && i < m_figure.own->mesh.vertexCount(); ++i) {
        box.add(m_figure.own->mesh.positions[i]);
    }
    if (!box.isEmpty()) {
        m_motion.show(box,
                      static_cast<float>(std::max(1, width())) / static_cast<float>(std::max(1, height())));
    }
    draw();
}

void BodyPreview::draw() {
    if (width() < 1 || height() < 1) {
        return;
    }
    if (!m_presenter->isReady()) {
        m_isWaiting = true;
        return;
    }
    auto frame = std::make_shared<SceneFrame>();
    frame->pixelRatio = static_cast<float>(devicePixelRatioF());
    frame->width = std::max(1, qRound(width() * devicePixelRatioF()));
    frame->height = std::max(1, qRound(height() * devicePixelRatioF()));
    frame->colours = themedSceneColours();
    frame->camera = m_motion.camera();
    if (m_figure.own != nullptr) {
        frame->figures.push_back(m_figure);
    }
    m_presenter->present(std::move(frame));
}

void BodyPreview::resizeEvent(QResizeEvent* /*event*/) {
    m_presenter->setGeometry(rect());
    draw();
}

void BodyPreview::mousePressEvent(QMouseEvent* event) {
    m_pointer = event->position();
}

void BodyPreview::mouseMoveEvent(QMouseEvent* event) {
    m_motion.orbit(event->position() - std::exchange(m_pointer, event->position()));
    draw();
}

void BodyPreview::keyPressEvent(QKeyEvent* event) {
    constexpr qreal kStep = 20; // as of a pointer, logical pixels
    const QPointF step = event->key() == Qt::Key_Left    ? QPointF(-kStep, 0)
                         : event->key() == Qt::Key_Right ? QPointF(kStep, 0)
                         : event->key() == Qt::Key_Up    ? QPointF(0, -kStep)
                         : event->key() == Qt::Key_Down  ? QPointF(0, kStep)
                                                         : QPointF();
    if (step.isNull()) {
        QWidget::keyPressEvent(event);
        return;
    }
    m_motion.orbit(step);
    draw();
}

} // namespace posewire::gui
