// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/drawing_thread.h"

#include "app/gui/viewport/scene_upload.h"
#include "render/offscreen.h"

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

} // namespace

DrawingThread::DrawingThread(std::function<void()> wake)
    : m_wake(std::move(wake)), m_thread([this] { run(); }) {}

DrawingThread::~DrawingThread() {
    {
        const std::lock_guard lock(m_mutex);
        m_isStopping = true;
    }
    m_hasWork.notify_one();
    m_thread.join();
}

void DrawingThread::draw(std::shared_ptr<const SceneFrame> frame) {
    {
        const std::lock_guard lock(m_mutex);
        m_next = std::move(frame);
    }
    m_hasWork.notify_one();
}

DrawingThread::Result DrawingThread::take() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_result, {});
}

void DrawingThread::give(Result result) {
    {
        const std::lock_guard lock(m_mutex);
        m_result = std::move(result);
    }
    m_wake();
}

/// Null when it is time to stop.
std::shared_ptr<const SceneFrame> DrawingThread::nextFrame() {
    std::unique_lock lock(m_mutex);
    m_hasWork.wait(lock, [this] { return m_isStopping || m_next != nullptr; });
    return m_isStopping ? nullptr : std::exchange(m_next, nullptr);
}

void DrawingThread::run() {
    yieldToOthers();
    auto renderer = render::OffscreenRenderer::create();
    if (!renderer) {
        give({std::nullopt, {}, renderer.error()});
        return;
    }
    SceneUpload upload;
    while (const auto frame = nextFrame()) {
        const render::Scene scene = upload.prepare(*frame, renderer->renderer());
        renderer->render(scene, frame->width, frame->height, frame->pixelRatio);
        give({renderer->takeImage(), renderer->renderer().rendererName(), {}});
    }
}

} // namespace posewire::gui
