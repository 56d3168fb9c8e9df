// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/scene_frame.h"
#include "render/image.h"

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace posewire::gui {

/// Draws frames in an OpenGL context of its own on a thread of its own. The newest frame handed in is the one
/// drawn; what it replaces is left out.
class DrawingThread {
public:
    /// What the thread has to say since the last take().
    struct Result {
        std::optional<render::Image> image; ///< Bgra
        std::string rendererName;
        std::string failure; ///< why there will be no pictures
    };

    /// `wake` is called on the drawing thread whenever there is something to take.
    explicit DrawingThread(std::function<void()> wake);
    ~DrawingThread();
    DrawingThread(const DrawingThread&) = delete;
    DrawingThread& operator=(const DrawingThread&) = delete;

    void draw(std::shared_ptr<const SceneFrame> frame);
    [[nodiscard]] Result take();

private:
    void run();
    [[nodiscard]] std::shared_ptr<const SceneFrame> nextFrame();
    void give(Result result);

    std::function<void()> m_wake;
    std::mutex m_mutex;
    std::condition_variable m_hasWork;
    std::shared_ptr<const SceneFrame> m_next;
    Result m_result;
    bool m_isStopping = false;
    std::thread m_thread; // last: it uses all the others
};

} // namespace posewire::gui
