// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/drawing_thread.h"

#include "app/system/process_figures.h"
#include "render/quality_ladder.h"

#include <algorithm>
#include <utility>

namespace posewire::gui {

namespace {

using SteadyClock = std::chrono::steady_clock;
using render::Simplification;

/// Without movement for so long, what is shown is drawn as well as it can be.
constexpr std::chrono::milliseconds kStillAfter(250);
/// The longest that a step which leaves out every other picture waits.
constexpr std::chrono::milliseconds kLongestPause(150);
/// From one picture to the next, at least: more of them than 36 a second take more than a processor.
constexpr std::chrono::milliseconds kLeastPeriod(26);

double secondsOf(SteadyClock::duration duration) {
    return std::chrono::duration<double>(duration).count();
}

} // namespace

/// What the thread remembers from one picture to the next.
class DrawingThread::Painter {
public:
    explicit Painter(render::OffscreenRenderer& renderer)
        : m_renderer(renderer), m_interactive(renderer.renderer().quality()) {}

    Result paint(const Task& task) {
        Result result;
        result.frame = task.frame;
        const std::shared_ptr<const SceneFrame> frame = task.isStill ? m_last : task.frame;
        const bool isChanged = !task.isStill && (m_last == nullptr || *task.frame != *m_last);
        const bool isBest = task.isStill || frame->isBest;
        if (isChanged || task.isStill) {
            const SteadyClock::time_point begin = SteadyClock::now();
            draw(*frame, isBest);
            const SteadyClock::time_point end = SteadyClock::now();
            if (isChanged && !isBest) {
                m_ladder.add(secondsOf(end - begin), secondsOf(end.time_since_epoch()));
                m_moved = end;
            }
            const auto took = std::chrono::duration_cast<std::chrono::milliseconds>(end - begin);
            result.pause = m_ladder.step() == Simplification::HalfRate
                               ? std::min(took, kLongestPause)
                               : std::max(kLeastPeriod - took, std::chrono::milliseconds(0));
            result.image = m_renderer.takeImage();
            m_isStill = isBest;
            m_last = frame;
        }
        result.rendererName = m_renderer.renderer().rendererName();
        result.load = {m_ladder.step(), m_ladder.typical(), m_ladder.cause(), m_ladder.budget(), m_isStill};
        return result;
    }

    void giveBack(render::Image image) { m_renderer.giveBack(std::move(image)); }

    /// When the last frame is to be drawn once more; nothing if it has been.
    [[nodiscard]] std::optional<SteadyClock::time_point> stillDue() const {
        return m_last == nullptr || m_isStill ? std::nullopt : std::optional(m_moved + kStillAfter);
    }

private:
    void draw(const SceneFrame& frame, bool isBest) {
        const Simplification step = m_ladder.step();
        render::RenderQuality quality = render::simplified(m_interactive, step);
        if (isBest) {
            quality = render::stillQuality(m_interactive, frame.width, frame.height);
        } else {
            const bool isMoving =
                m_last != nullptr && (frame.camera != m_last->camera ||
                                      !std::ranges::equal(frame.panes, m_last->panes, {}, &SceneFrame::camera,
                                                          &SceneFrame::camera));
            quality.plainFloor = isMoving && step != Simplification::None;
        }
        m_renderer.renderer().setQuality(quality);
        const bool hasFewAxes = !isBest && step >= Simplification::FewAxes;
        if (frame.panes.empty()) {
            m_renderer.render(sceneOf(frame, hasFewAxes), frame.width, frame.height, frame.pixelRatio);
            return;
        }
        std::vector<render::Pane> panes;
        std::ranges::transform(frame.panes, std::back_inserter(panes), &SceneFrame::place);
        m_renderer.render(panes, [&](std::size_t pane) { return sceneOf(frame.panes[pane], hasFewAxes); },
                          {frame.width, frame.height, 0, frame.pixelRatio});
    }

    render::Scene sceneOf(const SceneFrame& frame, bool hasFewAxes) {
        render::Scene scene = m_upload.prepare(frame, m_renderer.renderer());
        if (hasFewAxes) {
            scene.axes = scene.axes.subspan(frame.selectedAxes, frame.selectedAxesCount);
        }
        return scene;
    }

    render::OffscreenRenderer& m_renderer;
    render::RenderQuality m_interactive;
    SceneUpload m_upload;
    render::QualityLadder m_ladder;
    std::shared_ptr<const SceneFrame> m_last; ///< drawn
    bool m_isStill = false;                   ///< it was drawn as well as it can be
    SteadyClock::time_point m_moved;
};

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

void DrawingThread::giveBack(render::Image image) {
    const std::lock_guard lock(m_mutex);
    m_spare = std::move(image);
}

void DrawingThread::run(const std::stop_token& stop) {
    system::yieldToOthers(); // software OpenGL takes all the processor it is given
    auto renderer = render::OffscreenRenderer::create();
    if (!renderer) {
        Result failed;
        failed.failure = renderer.error();
        give(std::move(failed));
        return;
    }
    Painter painter(*renderer);
    while (const auto task = next(stop, painter.stillDue())) {
        std::optional<render::Image> spare;
        {
            const std::lock_guard lock(m_mutex);
            spare = std::exchange(m_spare, std::nullopt);
        }
        if (spare) {
            painter.giveBack(std::move(*spare));
        }
        give(painter.paint(*task));
    }
}

std::optional<DrawingThread::Task>
DrawingThread::next(const std::stop_token& stop, const std::optional<SteadyClock::time_point>& stillDue) {
    std::unique_lock lock(m_mutex);
    const auto hasWork = [this] { return m_next != nullptr; };
    if (stillDue) {
        m_hasWork.wait_until(lock, stop, *stillDue, hasWork);
    } else {
        m_hasWork.wait(lock, stop, hasWork);
    }
    if (stop.stop_requested()) {
        return std::nullopt;
    }
    return m_next != nullptr ? Task{std::exchange(m_next, nullptr), false} : Task{nullptr, true};
}

void DrawingThread::give(Result result) {
    {
        const std::lock_guard lock(m_mutex);
        if (!result.image) { // the one before it, where it was not taken yet, is what is shown
            result.image = std::move(m_result.image);
        }
        if (result.frame == nullptr) {
            result.frame = std::move(m_result.frame);
        }
        m_result = std::move(result);
    }
    m_wake();
}

} // namespace posewire::gui
