// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/logging.h"
#include "app/gui/theme/theme.h"
#include "app/gui/viewport/drawing_thread.h"

#include <QImage>
#include <QPainter>

#include <QTimer>

#include <memory>
#include <utility>

namespace posewire::gui {

namespace {

/// A picture, and the thread that its room goes back to: none for one that is gone by then.
struct Shown {
    render::Image image;
    std::weak_ptr<DrawingThread> from;
};

/// The image's own bytes, without a copy.
QImage wrapped(render::Image image, const std::shared_ptr<DrawingThread>& from) {
    auto* shown = new Shown{std::move(image), from};
    return {shown->image.pixels.data(),
            shown->image.width,
            shown->image.height,
            static_cast<qsizetype>(shown->image.stride()),
            QImage::Format_RGB32,
            [](void* pointer) {
                const std::unique_ptr<Shown> gone(static_cast<Shown*>(pointer));
                if (const auto thread = gone->from.lock()) {
                    thread->giveBack(std::move(gone->image));
                }
            },
            shown};
}

class SoftwarePresenter final : public Presenter {
public:
    explicit SoftwarePresenter(QWidget* parent)
        : Presenter(parent), m_thread(std::make_shared<DrawingThread>([this] {
              // The wake carries no data: what crosses between the threads is behind the thread's own lock.
              QMetaObject::invokeMethod(
                  this, [this] { take(); }, Qt::QueuedConnection);
          })) {
        setAttribute(Qt::WA_OpaquePaintEvent);
        m_pause.setSingleShot(true);
        connect(&m_pause, &QTimer::timeout, this, &Presenter::ready);
    }

    ~SoftwarePresenter() override { m_thread.reset(); } // it calls back

    [[nodiscard]] bool isReady() const override {
        return m_handed == nullptr && !m_pause.isActive() && m_failure.isEmpty();
    }
    void present(std::shared_ptr<const SceneFrame> frame) override {
        m_handed = frame;
        m_thread->draw(std::move(frame));
    }
    [[nodiscard]] QString rendererName() const override { return m_rendererName; }
    [[nodiscard]] QString failure() const override { return m_failure; }
    [[nodiscard]] PictureLoad load() const override { return m_load; }
    [[nodiscard]] std::uint64_t pictures() const override { return m_pictures; }

protected:
    void paintEvent(QPaintEvent* /*event*/) override {
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
            // While the window is being resized the picture has another size; stretching it beats a hole.
            painter.drawImage(rect(), m_picture);
            if (m_handed == nullptr) {
                QMetaObject::invokeMethod(this, &Presenter::outgrown, Qt::QueuedConnection);
            }
        }
    }

private:
    void take() {
        DrawingThread::Result result = m_thread->take();
        if (!result.failure.empty()) {
            m_failure = QString::fromStdString(result.failure);
            update();
            emit presented();
            return;
        }
        if (result.rendererName.empty()) {
            return; // an earlier wake has taken it all
        }
        if (result.image) {
            ++m_pictures;
            m_picture = wrapped(std::move(*result.image), m_thread);
            m_rendererName = QString::fromStdString(result.rendererName);
            update();
        }
        if (result.load.step != m_load.step) {
            qCInfo(drawingLog).noquote() << pictureHealthOf(result.load).state;
        }
        m_load = result.load;
        if (result.frame == nullptr || result.frame != m_handed) {
            return; // drawn once more, or by a wake that came too late
        }
        m_handed.reset();
        if (result.pause.count() > 0) {
            m_pause.start(result.pause);
        }
        emit presented();
    }

    std::shared_ptr<DrawingThread> m_thread;
    QImage m_picture;
    QString m_rendererName;
    QString m_failure;
    PictureLoad m_load;
    std::uint64_t m_pictures = 0;
    std::shared_ptr<const SceneFrame> m_handed; ///< not yet drawn
    QTimer m_pause;
};

} // namespace

Presenter* makeSoftwarePresenter(QWidget* parent) {
    return new SoftwarePresenter(parent);
}

QString windowlessOpenGlName() {
    const auto context = render::OffscreenContext::create();
    return QString::fromStdString(context ? context->driverName() : context.error());
}

} // namespace posewire::gui
