// SPDX-License-Identifier: MIT
#include "render/offscreen.h"

#include "render/gl/framebuffer.h"

#include <algorithm>

#include <epoxy/gl.h>

namespace posewire::render {
namespace {

/// Upside down is how OpenGL stores pictures.
void flipRows(Image& image) {
    const std::size_t stride = image.stride();
    for (int top = 0, bottom = image.height - 1; top < bottom; ++top, --bottom) {
        std::uint8_t* upper = image.pixels.data() + stride * static_cast<std::size_t>(top);
        std::uint8_t* lower = image.pixels.data() + stride * static_cast<std::size_t>(bottom);
        std::swap_ranges(upper, upper + stride, lower);
    }
}

} // namespace

std::string OffscreenContext::driverName() const {
    const auto text = [](GLenum name) {
        const GLubyte* value = glGetString(name);
        return value == nullptr
                   ? std::string("unknown")
                   : std::string(reinterpret_cast<const char*>(value)); // NOLINT: the API's own type
    };
    return text(GL_VERSION) + ", " + text(GL_RENDERER);
}

struct OffscreenRenderer::Impl {
    // The order matters: what belongs to the context has to go before it.
    OffscreenContext context;
    Renderer renderer;
    gl::Framebuffer framebuffer;
    Image image;
    Image spare;
    bool canInvertRows = false;

    Impl(OffscreenContext ownContext, Renderer ownRenderer)
        : context(std::move(ownContext)), renderer(std::move(ownRenderer)) {}
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    ~Impl() { context.makeCurrent(); }

    void resize(int width, int height);
    void readBack();
};

void OffscreenRenderer::Impl::resize(int width, int height) {
    if (framebuffer.width() != width || framebuffer.height() != height) {
        auto created = gl::Framebuffer::create(width, height);
        framebuffer = created ? std::move(*created) : gl::Framebuffer();
    }
    image.width = framebuffer.width();
    image.height = framebuffer.height();
    image.order = PixelOrder::Bgra;
    image.pixels.resize(image.stride() * static_cast<std::size_t>(image.height));
}

void OffscreenRenderer::Impl::readBack() {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer.name());
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    if (canInvertRows) {
        glPixelStorei(GL_PACK_INVERT_MESA, GL_TRUE);
    }
    glReadPixels(0, 0, image.width, image.height, GL_BGRA, GL_UNSIGNED_BYTE, image.pixels.data());
    if (!canInvertRows) {
        flipRows(image);
    }
}

OffscreenRenderer::OffscreenRenderer(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
OffscreenRenderer::OffscreenRenderer(OffscreenRenderer&&) noexcept = default;
OffscreenRenderer& OffscreenRenderer::operator=(OffscreenRenderer&&) noexcept = default;
OffscreenRenderer::~OffscreenRenderer() = default;

tl::expected<OffscreenRenderer, std::string> OffscreenRenderer::create(std::optional<RenderQuality> quality) {
    tl::expected<OffscreenContext, std::string> context = OffscreenContext::create();
    if (!context) {
        return tl::unexpected(context.error());
    }
    tl::expected<Renderer, std::string> renderer = Renderer::create(quality);
    if (!renderer) {
        return tl::unexpected(renderer.error());
    }
    auto impl = std::make_unique<Impl>(std::move(*context), std::move(*renderer));
    impl->canInvertRows = epoxy_has_gl_extension("GL_MESA_pack_invert");
    return OffscreenRenderer(std::move(impl));
}

Renderer& OffscreenRenderer::renderer() {
    return m_impl->renderer;
}

const Image& OffscreenRenderer::render(const Scene& scene, int width, int height, float pixelRatio) {
    m_impl->resize(std::max(width, 1), std::max(height, 1));
    m_impl->renderer.draw(
        scene, {m_impl->image.width, m_impl->image.height, m_impl->framebuffer.name(), pixelRatio});
    m_impl->readBack();
    return m_impl->image;
}

const Image& OffscreenRenderer::render(std::span<const Pane> panes,
                                       const std::function<Scene(std::size_t)>& sceneOf,
                                       const Viewport& size) {
    m_impl->resize(std::max(size.width, 1), std::max(size.height, 1));
    for (std::size_t i = 0; i < panes.size(); ++i) {
        const Image& image = m_impl->image;
        m_impl->renderer.drawPane(
            sceneOf(i), panes[i],
            {image.width, image.height, m_impl->framebuffer.name(), size.pixelRatio, i});
    }
    m_impl->readBack();
    return m_impl->image;
}

Image OffscreenRenderer::takeImage() {
    return std::exchange(m_impl->image, std::exchange(m_impl->spare, Image()));
}

void OffscreenRenderer::giveBack(Image image) {
    (m_impl->image.pixels.empty() ? m_impl->image : m_impl->spare) = std::move(image);
}

} // namespace posewire::render
