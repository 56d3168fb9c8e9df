// SPDX-License-Identifier: MIT
#pragma once

#include "render/image.h"
#include "render/renderer.h"

#include <functional>
#include <memory>
#include <span>
#include <string>

#include <tl/expected.hpp>

namespace posewire::render {

/// An OpenGL 3.3 core context that shows nothing: by EGL without display or X, on the surfaceless platform,
/// else on the first device that has one; on Windows by WGL, with a hidden window. Independent of any context
/// that the program has beside it (Qt's for example). `create` leaves it current on the calling thread; it
/// belongs to one thread at a time.
class OffscreenContext {
public:
    static tl::expected<OffscreenContext, std::string> create();

    OffscreenContext(OffscreenContext&&) noexcept;
    OffscreenContext& operator=(OffscreenContext&&) noexcept;
    ~OffscreenContext();

    /// Takes it to the calling thread; a thread that held it before has to call doneCurrent first.
    bool makeCurrent();
    void doneCurrent();

    /// Version and name of the OpenGL driver. To be asked where the context is current.
    [[nodiscard]] std::string driverName() const;

private:
    struct Impl;
    explicit OffscreenContext(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

/// A context, a renderer and a framebuffer of its own: scenes in, pictures in memory out. For windows where
/// OpenGL is software or absent, and for tests.
///
/// Threads: create it, use it and destroy it on one thread; a worker of its own keeps a window responsive.
/// A scene's spans must live until render returns. The picture belongs to this object and is overwritten by
/// the next render: a worker copies or swaps it out (takeImage) before it hands it to the window.
class OffscreenRenderer {
public:
    /// `quality` as for Renderer::create.
    static tl::expected<OffscreenRenderer, std::string> create(std::optional<RenderQuality> quality = {});

    OffscreenRenderer(OffscreenRenderer&&) noexcept;
    OffscreenRenderer& operator=(OffscreenRenderer&&) noexcept;
    ~OffscreenRenderer();

    /// For meshes, quality and name.
    Renderer& renderer();

    /// PixelOrder::Bgra, alpha 255: QImage::Format_RGB32 without conversion. Sizes are device pixels, at
    /// least 1.
    const Image& render(const Scene& scene, int width, int height, float pixelRatio = 1.0F);
    /// The same of several scenes, each in a part of the picture; `sceneOf` is asked for each just before it
    /// is drawn.
    const Image& render(std::span<const Pane> panes, const std::function<Scene(std::size_t)>& sceneOf,
                        const Viewport& size);
    /// Moves the last picture out.
    Image takeImage();
    /// For the next picture, so that its room is not made anew each time: one that was taken and is no longer
    /// needed.
    void giveBack(Image image);

private:
    struct Impl;
    explicit OffscreenRenderer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

} // namespace posewire::render
