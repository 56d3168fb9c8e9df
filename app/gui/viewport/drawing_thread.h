// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/presenter.h"
#include "render/offscreen.h"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace posewire::gui {

/// Draws frames in an OpenGL context of its own on a thread of its own. The newest frame handed in is the one
/// drawn; what it replaces is left out, and one that shows what is shown already is not drawn again. When
/// nothing has moved for a moment, what is shown is drawn once more as well as it can be.
class DrawingThread {
public:
    struct Result {
        std::optional<render::Image> image{};      ///< Bgra; nothing if the last one still holds
        std::shared_ptr<const SceneFrame> frame{}; ///< that is drawn now; null for one that nobody asked for
        std::string rendererName{};
        std::string failure{}; ///< why there will be no pictures
        PictureLoad load{};
        std::chrono::milliseconds pause{0}; ///< before the next is handed in, so that others have time
    };

    /// `wake` is called on the drawing thread whenever there is something to take.
    explicit DrawingThread(std::function<void()> wake)
        : m_wake(std::move(wake)), m_thread([this](const std::stop_token& stop) { run(stop); }) {}

    void draw(std::shared_ptr<const SceneFrame> frame);
    [[nodiscard]] Result take();
    /// The room of a picture that is no longer shown, for another; on any thread.
    void giveBack(render::Image image);

private:
    class Painter;
    struct Task {
        std::shared_ptr<const SceneFrame> frame; ///< null for the last one once more
        bool isStill = false;
    };

    void run(const std::stop_token& stop);
    /// Nothing when it is time to stop. `stillDue`: when to draw the last frame once more.
    [[nodiscard]] std::optional<Task>
    next(const std::stop_token& stop, const std::optional<std::chrono::steady_clock::time_point>& stillDue);
    void give(Result result);

    std::function<void()> m_wake;
    std::mutex m_mutex;
    std::condition_variable_any m_hasWork;
    std::shared_ptr<const SceneFrame> m_next;
    Result m_result;
    std::optional<render::Image> m_spare;
    std::jthread m_thread; // last: it uses all the others, and is stopped first
};

} // namespace posewire::gui
