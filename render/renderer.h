// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/mesh.h"
#include "render/mesh/prop_shapes.h"
#include "render/scene.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

namespace posewire::render {

/// How much work goes into a picture.
struct RenderQuality {
    /// Samples per pixel of multisampling; 0 or 1 is none.
    int samples = 4;
    /// Smooths the figures' edges by looking at the finished picture: cheap where multisampling is expensive.
    bool edgeSmoothing = false;
    /// Texels a side of the light's depth picture, and of the softened shadow on the floor.
    int shadowMapSize = 2048;
    int floorShadowSize = 1024;
    /// Characters drawn before waiting for the driver, 0 to never wait. One that draws with the processor
    /// keeps about 2 MB of triangles for each character it was given and has not drawn.
    int charactersAtOnce = 0;
    /// Background and floor are drawn once and copied while camera, size and colours hold: for renderers on
    /// the processor. Without multisampling only.
    bool keepsBackdrop = false;
    /// The floor is one flat colour with its lines over it, for the pictures of a camera that moves; with
    /// keepsBackdrop only.
    bool plainFloor = false;
    /// Shadows are those of the low meshes.
    bool lowShadows = false;
    /// Bodies that are less tall than this in the picture are drawn by their low meshes; device pixels. Where
    /// a segment is selected, only those that are small anyhow.
    float lowBodiesBelow = 0.0F;
    /// Where a body shades itself, the edge of the shadow is not softened.
    bool hardSelfShadow = false;

    bool operator==(const RenderQuality&) const = default;
};

/// Whether OpenGL is drawn by the processor (llvmpipe, softpipe, swrast).
bool isSoftwareRenderer(std::string_view rendererName);
/// What suits a renderer when pictures follow one another: `rendererName` is GL_RENDERER.
RenderQuality interactiveQuality(std::string_view rendererName);
/// For a picture that stays, on a renderer of which others are asked `interactive`.
RenderQuality stillQuality(const RenderQuality& interactive, int width, int height);

/// Where to draw: an existing framebuffer object with colour and depth, 0 for the default one.
struct Viewport {
    int width = 0;
    int height = 0;
    unsigned framebuffer = 0;
    /// Device pixels per logical pixel: widths of lines and points are scaled by it.
    float pixelRatio = 1.0F;
    /// Which of several views that are drawn in turn: what is kept from picture to picture is kept for each.
    std::size_t view = 0;
};

/// As many views as have something kept of their own.
inline constexpr std::size_t kMostViews = 4;

/// A part of a picture in device pixels, from its top left.
struct Pane {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

/// Draws scenes in the OpenGL context that was current at `create`: any context of 3.3 or newer.
/// Every call, the destructor included, needs that context current on the calling thread. It leaves
/// bindings, viewport and enables changed; a caller that draws as well sets its own.
class Renderer {
public:
    /// `quality` defaults to interactiveQuality. The error says what is missing: the OpenGL version, or the
    /// shader compiler's own text.
    static tl::expected<Renderer, std::string> create(std::optional<RenderQuality> quality = {});

    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;
    ~Renderer();

    /// GL_RENDERER.
    const std::string& rendererName() const;
    const RenderQuality& quality() const;
    /// For the pictures from here on. Sizes of shadows that the driver refuses stay as they were.
    void setQuality(const RenderQuality& quality);

    /// The mannequin, in one of its levels, for all characters that are fitted to it: SkinnedInstance::fit
    /// makes it the body of each. MeshId::None where mesh.validate() fails.
    MeshId uploadMesh(const SkinnedMesh& mesh);
    /// A mesh with joints, colours and textures of its own. MeshId::None where they do not fit together.
    MeshId uploadMesh(const SkinnedMesh& mesh, const MeshDress& dress);
    /// A prop, of one joint, in a colour that no suit has.
    MeshId uploadMesh(PropShape shape);
    void releaseMesh(MeshId id);

    /// Whether the driver was reset and all that this holds is lost, as far as the context tells: it must
    /// have been made with notification of resets.
    bool isContextLost() const;

    /// Leaves out characters whose mesh is unknown or whose palette is too short.
    void draw(const Scene& scene, const Viewport& viewport);

    /// Draws into a part of a target, which keeps what else is in it; Viewport::view is one of kMostViews.
    void drawPane(const Scene& scene, const Pane& pane, const Viewport& whole);

    /// For measuring: from now on the driver finishes each pass before the next begins, and `passed` is
    /// called with its name. Drawing takes longer so. Empty ends it.
    void observePasses(std::function<void(std::string_view)> passed);

    /// Positions as the vertex shader skins them, in the order of the mesh's own vertices: the tests compare
    /// SkinJob with them. Empty where the mesh is unknown or the palette short.
    std::vector<glm::vec3> skinnedPositions(MeshId id, std::span<const DualQuaternion> palette,
                                            std::span<const Stretch> fit = {});

private:
    struct Impl;
    explicit Renderer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

} // namespace posewire::render
