// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/scene_frame.h"
#include "render/renderer.h"

#include <map>
#include <memory>
#include <vector>

namespace posewire::gui {

/// Turns frames into scenes for one renderer: uploads meshes when they are first seen, releases those no
/// longer shown. Belongs to the renderer's thread.
class SceneUpload {
public:
    /// The spans of the result last until the next call, and no longer than `frame`.
    [[nodiscard]] render::Scene prepare(const SceneFrame& frame, render::Renderer& renderer);

private:
    void add(const Figure& figure, render::Renderer& renderer);
    void releaseUnused(const SceneFrame& frame, render::Renderer& renderer);

    std::map<std::shared_ptr<const FigureMesh>, render::MeshId> m_meshes;
    std::vector<render::SkinnedInstance> m_instances;
};

} // namespace posewire::gui
