// SPDX-License-Identifier: MIT
#include "render/renderer.h"

#include "render/gl/framebuffer.h"
#include "render/passes/edges.h"
#include "render/passes/floor_shadows.h"
#include "render/passes/frame.h"
#include "render/passes/instances.h"
#include "render/passes/marks.h"
#include "render/passes/outline.h"
#include "render/passes/palettes.h"
#include "render/passes/shader_sources.h"
#include "render/passes/shadow.h"
#include "render/passes/skinned.h"
#include "render/passes/surroundings.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <epoxy/gl.h>

namespace posewire::render {
namespace {

constexpr int kLowestVersion = 33;

std::string glText(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? std::string()
                           : reinterpret_cast<const char*>(text); // NOLINT: the API's own type
}

int integer(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

/// Moves the value of a result out, or keeps its error.
template <typename T>
bool take(tl::expected<T, std::string>&& result, std::optional<T>& into, std::string& error) {
    if (!result) {
        error = std::move(result.error());
        return false;
    }
    into = std::move(*result);
    return true;
}

} // namespace

struct Renderer::Impl {
    std::string name;
    RenderQuality quality;
    MeshStore meshes;
    gl::Buffer frameBuffer;
    Palettes palettes;
    Instances instances;
    std::optional<ShadowPass> shadow;
    std::optional<SkinnedPass> skinned;
    std::optional<SurroundingsPass> surroundings;
    std::optional<OutlinePass> outline;
    std::optional<FloorShadows> floorShadows;
    std::optional<EdgePass> edges;
    std::optional<MarksPass> marks;
    /// Only where the quality asks for samples and the target has none.
    gl::Framebuffer multisampled;
    /// Of panes, by view.
    std::array<gl::Framebuffer, kMostViews> paneTargets;
    Frame frame;
    std::function<void(std::string_view)> passed;

    /// Says so where somebody measures.
    void pass(std::string_view what) const;
    /// The framebuffer to draw into for a viewport.
    unsigned target(const Viewport& viewport, bool& isMultisampled);
    /// Whether what is behind the characters comes from a copy: the floor must be opaque for that.
    bool isBackdropKept(bool isMultisampled) const;
    void drawPasses(unsigned target, bool isMultisampled);
};

void Renderer::Impl::pass(std::string_view what) const {
    if (passed) {
        glFinish();
        passed(what);
    }
}

unsigned Renderer::Impl::target(const Viewport& viewport, bool& isMultisampled) {
    glBindFramebuffer(GL_FRAMEBUFFER, viewport.framebuffer);
    isMultisampled = integer(GL_SAMPLES) > 1;
    const int samples = std::min(quality.samples, integer(GL_MAX_SAMPLES));
    if (isMultisampled || samples < 2) {
        return viewport.framebuffer;
    }
    if (multisampled.width() != viewport.width || multisampled.height() != viewport.height ||
        multisampled.samples() != samples) {
        auto created = gl::Framebuffer::create(viewport.width, viewport.height, samples);
        if (!created) {
            // Without smoothing is better than without a picture.
            return viewport.framebuffer;
        }
        multisampled = std::move(*created);
    }
    isMultisampled = true;
    return multisampled.name();
}

bool Renderer::Impl::isBackdropKept(bool isMultisampled) const {
    const bool isSeenThrough = frame.scene->showFloor && frame.block.style.w < 1.0F;
    return quality.keepsBackdrop && !isMultisampled && !isSeenThrough;
}

void Renderer::Impl::drawPasses(unsigned target, bool isMultisampled) {
    const bool isKept = isBackdropKept(isMultisampled);
    if (isKept) {
        surroundings->drawKept(frame, quality.plainFloor, target);
        pass("backdrop");
    }
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    skinned->drawSolid(instances, quality, isKept && frame.scene->showFloor);
    pass("bodies");
    if (!isKept) {
        surroundings->draw(frame);
        pass("surroundings");
    } else if (frame.scene->showFloor) {
        floorShadows->draw(frame);
        pass("shadows on the floor");
    }
    outline->draw(frame, instances, isKept && frame.scene->showFloor);
    pass("outlines");
    skinned->drawGhosts(frame, instances);
    if (quality.edgeSmoothing && !isMultisampled) {
        edges->draw(frame);
        pass("edges");
    }
    marks->draw();
    pass("marks");
}

Renderer::Renderer(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

tl::expected<Renderer, std::string> Renderer::create(std::optional<RenderQuality> quality) {
    const int version = epoxy_gl_version();
    if (!epoxy_is_desktop_gl() || version < kLowestVersion) {
        return tl::unexpected("OpenGL 3.3 is needed; this driver (" + glText(GL_RENDERER) + ") offers " +
                              glText(GL_VERSION));
    }
    auto impl = std::make_unique<Impl>();
    impl->name = glText(GL_RENDERER);
    impl->quality = quality.value_or(interactiveQuality(impl->name));
    impl->frameBuffer = gl::Buffer::create();
    std::string error;
    const bool isComplete = take(ShadowPass::create(impl->quality), impl->shadow, error) &&
                            take(SkinnedPass::create(), impl->skinned, error) &&
                            take(SurroundingsPass::create(), impl->surroundings, error) &&
                            take(OutlinePass::create(), impl->outline, error) &&
                            take(FloorShadows::create(), impl->floorShadows, error) &&
                            take(EdgePass::create(), impl->edges, error) &&
                            take(MarksPass::create(), impl->marks, error);
    if (!isComplete) {
        return tl::unexpected(error);
    }
    return Renderer(std::move(impl));
}

const std::string& Renderer::rendererName() const {
    return m_impl->name;
}

const RenderQuality& Renderer::quality() const {
    return m_impl->quality;
}

void Renderer::setQuality(const RenderQuality& quality) {
    const RenderQuality before = std::exchange(m_impl->quality, quality);
    if (quality.samples < 2) {
        m_impl->multisampled = {};
    }
    if (!m_impl->shadow->resize(quality)) {
        m_impl->quality.shadowMapSize = before.shadowMapSize;
        m_impl->quality.floorShadowSize = before.floorShadowSize;
    }
}

MeshId Renderer::uploadMesh(const SkinnedMesh& mesh) {
    return m_impl->meshes.add(mesh);
}

MeshId Renderer::uploadMesh(const SkinnedMesh& mesh, const MeshDress& dress) {
    return m_impl->meshes.add(mesh, dress);
}

MeshId Renderer::uploadMesh(PropShape shape) {
    const SkinnedMesh mesh = propMesh(shape);
    constexpr std::array<Segment, 1> kJoint{};
    std::array<int, kSegmentCount> noSegments{};
    noSegments.fill(-1);
    MeshPart whole;
    whole.indexCount = static_cast<std::uint32_t>(mesh.indices.size());
    whole.colour = {0.66F, 0.63F, 0.58F}; // stands out from the floors of both themes
    whole.hasColour = true;
    return uploadMesh(mesh, MeshDress{kJoint, noSegments, {}, std::span(&whole, 1), {}});
}

void Renderer::releaseMesh(MeshId id) {
    m_impl->meshes.remove(id);
}

bool Renderer::isContextLost() const {
    if (epoxy_gl_version() >= 45) {
        return glGetGraphicsResetStatus() != GL_NO_ERROR;
    }
    if (epoxy_has_gl_extension("GL_KHR_robustness")) {
        return glGetGraphicsResetStatusKHR() != GL_NO_ERROR;
    }
    return epoxy_has_gl_extension("GL_ARB_robustness") && glGetGraphicsResetStatusARB() != GL_NO_ERROR;
}

void Renderer::draw(const Scene& scene, const Viewport& viewport) {
    if (viewport.width < 1 || viewport.height < 1) {
        return;
    }
    Frame& frame = m_impl->frame;
    planFrame(scene, viewport, m_impl->meshes, m_impl->quality, frame);
    m_impl->frameBuffer.upload(std::span<const FrameBlock>(&frame.block, 1), gl::Buffer::Usage::Stream);
    m_impl->frameBuffer.bindUniform(kFrameBinding);
    m_impl->palettes.upload(frame);
    m_impl->palettes.bind();
    m_impl->instances.upload(frame, m_impl->quality.charactersAtOnce);
    m_impl->marks->upload(scene);
    m_impl->pass("planning");
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_STENCIL_TEST);
    glFrontFace(GL_CCW);
    glCullFace(GL_BACK);
    m_impl->shadow->drawDepth(m_impl->instances);
    m_impl->pass("light's picture");
    m_impl->shadow->drawFloorShadow(frame);
    m_impl->pass("floor shadow");
    m_impl->shadow->bind();

    bool isMultisampled = false;
    const unsigned target = m_impl->target(viewport, isMultisampled);
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glViewport(0, 0, viewport.width, viewport.height);
    m_impl->drawPasses(target, isMultisampled);
    if (target != viewport.framebuffer) {
        m_impl->multisampled.resolveTo(viewport.framebuffer);
        glBindFramebuffer(GL_FRAMEBUFFER, viewport.framebuffer);
    }
    glBindVertexArray(0);
    glUseProgram(0);
    glActiveTexture(GL_TEXTURE0);
}

void Renderer::drawPane(const Scene& scene, const Pane& pane, const Viewport& whole) {
    if (pane.width < 1 || pane.height < 1 || whole.view >= kMostViews) {
        return;
    }
    gl::Framebuffer& target = m_impl->paneTargets[whole.view];
    if (target.width() != pane.width || target.height() != pane.height) {
        auto created = gl::Framebuffer::create(pane.width, pane.height);
        if (!created) {
            return;
        }
        target = std::move(*created);
    }
    draw(scene, {pane.width, pane.height, target.name(), whole.pixelRatio, whole.view});
    target.copyTo(whole.framebuffer, pane.x, whole.height - pane.y - pane.height);
    glBindFramebuffer(GL_FRAMEBUFFER, whole.framebuffer);
}

void Renderer::observePasses(std::function<void(std::string_view)> passed) {
    m_impl->passed = std::move(passed);
}

std::vector<glm::vec3> Renderer::skinnedPositions(MeshId id, std::span<const DualQuaternion> palette,
                                                  std::span<const Stretch> fit) {
    const SkinnedInstance instance{id, MeshId::None, palette, {}, fit};
    Scene scene;
    scene.characters = std::span(&instance, 1);
    Frame frame;
    planFrame(scene, {1, 1}, m_impl->meshes, m_impl->quality, frame);
    if (frame.characters.empty()) {
        return {};
    }
    m_impl->palettes.upload(frame);
    m_impl->palettes.bind();
    m_impl->instances.upload(frame, 0);
    const DrawnCharacter& only = frame.characters.front();
    return m_impl->skinned->record(m_impl->instances, Instances::only(frame, only, *only.mesh));
}

} // namespace posewire::render
