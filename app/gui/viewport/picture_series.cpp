// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/picture_series.h"

#include "app/gui/base/saving.h"
#include "app/gui/viewport/drawing_thread.h"

#include <QBuffer>
#include <QFileInfo>
#include <QPainter>

#include <utility>

namespace posewire::gui {
namespace {

QByteArray compressed(const QImage& picture) {
    constexpr int kQuick = 60; // of PNG: the larger the faster, and the larger the file
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    return picture.save(&buffer, "PNG", kQuick) ? bytes : QByteArray();
}

} // namespace

QString PictureRequest::pathOf(int number) const {
    if (count == 1) {
        return path;
    }
    const auto digits = static_cast<int>(QString::number(count).size());
    const QString suffix = QFileInfo(path).suffix();
    const QString stem = suffix.isEmpty() ? path : path.chopped(suffix.size() + 1);
    return QStringLiteral("%1_%2.png").arg(stem).arg(number + 1, digits, 10, QLatin1Char('0'));
}

PictureSeries::PictureSeries(model::SessionView& session, Playback& playback, const ViewLook& look,
                             PictureRequest request)
    : m_session(session),
      m_playback(playback),
      m_look(look),
      m_request(std::move(request)),
      m_builder(session, render::Detail::High),
      m_wasLive(session.choices().cursor.mode == model::Cursor::Mode::Following),
      m_shownBefore(session.cursorStamp()),
      m_thread(std::make_unique<DrawingThread>([this] {
          QMetaObject::invokeMethod(
              this, [this] { take(); }, Qt::QueuedConnection);
      })) {
    m_overlay->resize((QSizeF(m_request.size) / m_request.scale).toSize());
}

PictureSeries::~PictureSeries() {
    m_thread.reset();
    if (m_isLeft) {
        return;
    }
    if (m_wasLive) {
        m_playback.goLive();
    } else {
        m_playback.showMoment(m_shownBefore, true);
    }
}

void PictureSeries::showNext() {
    m_playback.showMoment(m_request.first + m_shown * m_request.every, true);
    draw(m_shown == 0 ? 0 : log::secondsOf(m_request.every));
}

void PictureSeries::draw(double seconds) {
    auto frame = std::make_shared<SceneFrame>();
    frame->width = m_request.size.width();
    frame->height = m_request.size.height();
    frame->pixelRatio = static_cast<float>(m_request.scale);
    frame->isBest = true;
    m_look.fill(m_builder, seconds, *frame);
    m_frame = frame;
    m_thread->draw(std::move(frame));
}

void PictureSeries::take() {
    DrawingThread::Result result = m_thread->take();
    if (m_isOver) {
        return;
    }
    if (!result.failure.empty()) {
        end(tr("No pictures: %1").arg(QString::fromStdString(result.failure)));
        return;
    }
    if (result.image) {
        const render::Image& image = *result.image;
        m_drawn = QImage(image.pixels.data(), image.width, image.height,
                         static_cast<qsizetype>(image.stride()), QImage::Format_RGB32)
                      .copy();
        m_thread->giveBack(std::move(*result.image));
    }
    if (result.frame != nullptr && result.frame == m_frame) {
        compose();
    }
}

void PictureSeries::compose() {
    QImage picture = m_drawn;
    const QSizeF size = m_overlay->size();
    m_overlay->setLabels(labelsOf(*m_frame, m_session, size));
    m_overlay->setTexts(textsOf(*m_frame, size));
    {
        QPainter painter(&picture);
        painter.scale(m_request.scale, m_request.scale);
        m_overlay->render(&painter, QPoint(), QRegion(), QWidget::DrawChildren);
    }
    if (!writeCompressed()) {
        return;
    }
    m_compressed = std::async(std::launch::async, [picture] { return compressed(picture); });
    ++m_shown;
    if (m_shown < m_request.count) {
        showNext();
    } else if (writeCompressed()) {
        end({});
    }
}

bool PictureSeries::writeCompressed() {
    if (!m_compressed.valid()) {
        return true;
    }
    const QByteArray bytes = m_compressed.get();
    const QString problem = bytes.isEmpty()
                                ? tr("Could not write a picture as PNG: there is too little memory for it.")
                                : saveFile(m_request.pathOf(m_written), bytes);
    if (!problem.isEmpty()) {
        end(problem);
        return false;
    }
    ++m_written;
    emit progressed();
    return true;
}

void PictureSeries::end(const QString& problem) {
    m_isOver = true;
    emit finished(problem);
}

} // namespace posewire::gui
