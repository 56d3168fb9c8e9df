// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/theme.h"
#include "app/gui/viewport/presenter.h"
#include "render/offscreen.h"

#include <QImage>
#include <QPainter>

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#ifdef __linux__
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace posewire::gui {

namespace {

/// Software OpenGL takes all the processor it is given: receiving and the window go first. The threads that
/// the driver starts inherit this.
void yieldToOthers() {
#ifdef __linux__
    constexpr int kNice = 8;
    setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kNice);
#endif
}

/// Draws frames in an OpenGL context of its own on a thread of its own. The newest frame handed in is the one
/// drawn; what it replaces is left out.
class DrawingThread {
public:
    /// What there is to say since the last take().
    struct Result {
        std::optional<render::Image> image{}; ///< Bgra
        std::string rendererName{};
        std::string failure{}; ///< why there will be no pictures
    };

    /// `wake` is called on the drawing thread whenever there is something to take.
    explicit DrawingThread(std::function<void()> wake)
        : m_wake(std::move(wake)), m_thread([this](const std::stop_token& stop) { run(stop); }) {}

    void draw(std::shared_ptr<const SceneFrame> frame) {
        {
            const std::lock_guard lock(m_mutex);
            m_next = std::move(frame);
        }
        m_hasWork.notify_one();
    }

    [[nodiscard]] Result take() {
        const std::lock_guard lock(m_mutex);
        return std::exchange(m_result, {});
    }

private:
    void run(const std::stop_token& stop) {
        yieldToOthers();
        auto renderer = render::OffscreenRenderer::create();
        if (!renderer) {
            give({std::nullopt, {}, renderer.error()});
            return;
        }
        SceneUpload upload;
        while (const auto frame = nextFrame(stop)) {
            const render::Scene scene = upload.prepare(*frame, renderer->renderer());
            renderer->render(scene, frame->width, frame->height, frame->pixelRatio);
            give({renderer->takeImage(), renderer->renderer().rendererName(), {}});
        }
    }

    /// Null when it is time to stop.
    [[nodiscard]] std::shared_ptr<const SceneFrame> nextFrame(const std::stop_token& stop) {
        std::unique_lock lock(m_mutex);
        m_hasWork.wait(lock, stop, [this] { return m_next != nullptr; });
        return stop.stop_requested() ? nullptr : std::exchange(m_next, nullptr);
    }

    void give(Result result) {
        {
            const std::lock_guard lock(m_mutex);
            m_result = std::move(result);
        }
        m_wake();
    }

    std::function<void()> m_wake;
    std::mutex m_mutex;
    std::condition_variable_any m_hasWork;
    std::shared_ptr<const SceneFrame> m_next;
    Result m_result;
    std::jthread m_thread; // last: it uses all the others, and is stopped first
};

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

class SoftwarePresenter final : public Presenter {
public:
    explicit SoftwarePresenter(QWidget* parent)
        : Presenter(parent), m_thread([this] {
              // The wake carries no data: what crosses between the threads is behind the thread's own lock.
              QMetaObject::invokeMethod(
                  this, [this] { take(); }, Qt::QueuedConnection);
          }) {
        setAttribute(Qt::WA_OpaquePaintEvent);
    }

    [[nodiscard]] bool isReady() const override { return !m_isDrawing && m_failure.isEmpty(); }
    void present(std::shared_ptr<const SceneFrame> frame) override {
        m_isDrawing = true;
        m_thread.draw(std::move(frame));
    }
    [[nodiscard]] QString rendererName() const override { return m_rendererName; }
    [[nodiscard]] QString failure() const override { return m_failure; }

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
        }
    }

private:
    void take() {
        DrawingThread::Result result = m_thread.take();
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

    QImage m_picture;
    QString m_rendererName;
    QString m_failure;
    bool m_isDrawing = false;
    DrawingThread m_thread; // last: it may call back at once
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
