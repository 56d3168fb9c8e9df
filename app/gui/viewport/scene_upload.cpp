// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/scene_upload.h"

#include <algorithm>

namespace posewire::gui {

render::Scene SceneUpload::prepare(const SceneFrame& frame, render::Renderer& renderer) {
    releaseUnused(frame, renderer);
    m_instances.clear();
    for (const auto* figures : {&frame.figures, &frame.ghosts}) {
        for (const Figure& figure : *figures) {
            add(figure, renderer);
        }
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

void SceneUpload::add(const Figure& figure, render::Renderer& renderer) {
    const auto [entry, isNew] = m_meshes.try_emplace(figure.mesh, render::MeshId::None);
    if (isNew) {
        entry->second = renderer.uploadMesh(figure.mesh->mesh, figure.mesh->templatePositions);
    }
    m_instances.push_back({entry->second, figure.palette, figure.look});
}

void SceneUpload::releaseUnused(const SceneFrame& frame, render::Renderer& renderer) {
    std::erase_if(m_meshes, [&](const auto& entry) {
        const auto isItsOwn = [&](const Figure& figure) { return figure.mesh == entry.first; };
        const bool isUsed =
            std::ranges::any_of(frame.figures, isItsOwn) || std::ranges::any_of(frame.ghosts, isItsOwn);
        if (!isUsed) {
            renderer.releaseMesh(entry.second);
        }
        return !isUsed;
    });
}

} // namespace posewire::gui
