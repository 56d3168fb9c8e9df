// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/software_presenter.h"

#include "app/gui/theme/theme.h"

#include <QPainter>

#include <utility>

namespace posewire::gui {

namespace {

/// The image's own bytes, without a copy.
QImage wrapped(render::Image image) {
    auto* owner = new render::Image(std::move(image));
    return {owner->pixels.data(),
            owner->width,
            owner->height,
            static_cast<qsizetype>(owner->stride()),
            QImage::Format_RGB32,
            [](void* pointer) { delete static_cast<render::Image*>(pointer); },
            owner};
}

} // namespace

SoftwarePresenter::SoftwarePresenter(QWidget* parent) : Presenter(parent) {
    setAttribute(Qt::WA_OpaquePaintEvent);
    // The wake carries no data: what crosses between the threads is behind the drawing thread's own lock.
    m_thread = std::make_unique<DrawingThread>([this] {
        QMetaObject::invokeMethod(
            this, [this] { take(); }, Qt::QueuedConnection);
    });
}

SoftwarePresenter::~SoftwarePresenter() = default;

void SoftwarePresenter::present(std::shared_ptr<const SceneFrame> frame) {
    m_isDrawing = true;
    m_thread->draw(std::move(frame));
}

void SoftwarePresenter::take() {
    DrawingThread::Result result = m_thread->take();
    if (!result.failure.empty()) {
        m_failure = QString::fromStdString(result.failure);
    }
    if (result.image) {
        m_isDrawing = false;
        m_rendererName = QString::fromStdString(result.rendererName);
        m_picture = wrapped(std::move(*result.image));
    }
    update();
    emit presented();
}

void SoftwarePresenter::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    if (m_picture.isNull()) {
        painter.fillRect(rect(), theme().panel);
        return;
    }
    const QSize pixels(qRound(width() * devicePixelRatioF()), qRound(height() * devicePixelRatioF()));
    if (m_picture.size() == pixels) {
        m_picture.setDevicePixelRatio(devicePixelRatioF());
        painter.drawImage(QPointF(), m_picture);
    } else {
        // While the window is being resized the picture in hand has another size; stretching it beats a hole.
        painter.drawImage(rect(), m_picture);
    }
}

} // namespace posewire::gui
