// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/scene_upload.h"

#include <algorithm>

namespace posewire::gui {

render::Scene SceneUpload::prepare(const SceneFrame& frame, render::Renderer& renderer) {
    releaseUnused(frame, renderer);
    m_instances.clear();
    for (const Figure& figure : frame.figures) {
        const auto [entry, isNew] = m_meshes.try_emplace(figure.mesh, render::MeshId::None);
        if (isNew) {
            entry->second = renderer.uploadMesh(figure.mesh->mesh, figure.mesh->templatePositions);
        }
        render::SkinnedInstance instance;
        instance.mesh = entry->second;
        instance.palette = figure.palette;
        instance.colour = figure.colour;
        instance.dim = figure.dim;
        instance.hatched = figure.isHatched;
        instance.selectedSegment = figure.selectedSegment;
        m_instances.push_back(instance);
    }
    render::Scene scene;
    scene.camera = frame.camera;
    scene.light = render::keyLight(frame.camera);
    scene.colours = frame.colours;
    scene.characters = m_instances;
    scene.axes = frame.axes;
    scene.lines = frame.lines;
    scene.points = frame.points;
    return scene;
}

void SceneUpload::releaseUnused(const SceneFrame& frame, render::Renderer& renderer) {
    std::erase_if(m_meshes, [&](const auto& entry) {
        const bool isUsed = std::ranges::any_of(
            frame.figures, [&](const Figure& figure) { return figure.mesh == entry.first; });
        if (!isUsed) {
            renderer.releaseMesh(entry.second);
        }
        return !isUsed;
    });
}

} // namespace posewire::gui
