// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/view_choice.h"

#include "app/gui/viewport/overlays.h"

#include <algorithm>

namespace posewire::gui {

namespace {

/// In settings, by ViewSwitch.
constexpr std::array kSwitchKeys{"scale", "segmentCard", "interpolation", "relativeViews"};

} // namespace

ViewChoice::ViewChoice(QObject* parent) : QObject(parent) {
    connect(&m_ownCharacters, &OwnCharacters::changed, this, [this] {
        m_look.wardrobe = m_ownCharacters.wardrobe();
        emit cameraMoved();
    });
}

void ViewChoice::setAxes(AxesMode mode) {
    m_look.axes = mode;
    emit changed();
}

void ViewChoice::toggle(Overlay overlay) {
    m_look.overlays.toggle(overlay);
    emit changed();
}

void ViewChoice::toggleSwitch(ViewSwitch which) {
    m_switches.at(static_cast<std::size_t>(which)) = !isSwitchedOn(which);
    m_look.hasScale = isSwitchedOn(ViewSwitch::Scale);
    emit changed();
}

void ViewChoice::split(int count, float heading) {
    m_look.panes.split(count, heading);
    emit changed();
}

void ViewChoice::activate(int pane) {
    if (pane != m_look.panes.active()) {
        m_look.panes.activate(pane);
        emit changed();
    }
}

void ViewChoice::toggleProjection() {
    m_look.panes.motion().setProjection(projection() == render::Projection::Perspective
                                            ? render::Projection::Orthographic
                                            : render::Projection::Perspective);
    emit changed();
}

void ViewChoice::face(render::StandardView view, float heading) {
    m_look.panes.motion().face(view);
    m_look.panes.motion().turn(heading);
    emit cameraMoved();
}

void ViewChoice::orbitBy(int right, int up) {
    constexpr double kStep = 24; // pixels of a drag: about 10°
    m_look.panes.motion().orbit(kStep * QPointF(-right, up));
    emit cameraMoved();
}

void ViewChoice::panBy(int right, int up) {
    constexpr double kStep = 0.05; // of the height
    const QSize view = m_look.panes.place().size();
    m_look.panes.motion().pan(kStep * view.height() * QPointF(-right, up), view);
    emit cameraMoved();
}

void ViewChoice::zoomBy(int steps) {
    const QSizeF view = m_look.panes.place().size();
    m_look.panes.motion().zoom(steps, QRectF({}, view).center(), view);
    emit cameraMoved();
}

void ViewChoice::showKeptView(int index) {
    if (isKept(index)) {
        restore(m_look.panes.motion(), m_keptViews.at(static_cast<std::size_t>(index)));
        emit changed();
    }
}

QJsonObject ViewChoice::state() const {
    QJsonArray on;
    for (const OverlayEntry& entry : kOverlayTable) {
        if (isOn(entry.overlay)) {
            on.append(QLatin1String(entry.key));
        }
    }
    QJsonArray views;
    for (const QJsonObject& view : m_keptViews) {
        views.append(view);
    }
    QJsonObject state{{"panes", m_look.panes.state()},
                      {"axes", static_cast<int>(m_look.axes)},
                      {"overlays", on},
                      {"ownCharacters", m_ownCharacters.state()},
                      {"views", views}};
    for (std::size_t i = 0; i < kSwitchKeys.size(); ++i) {
        state[QLatin1String(kSwitchKeys.at(i))] = m_switches.at(i);
    }
    return state;
}

void ViewChoice::restoreState(const QJsonObject& state) {
    restore(m_look.panes.motion(), state["camera"].toObject()); // as versions wrote it that had one view
    m_look.panes.restoreState(state["panes"].toObject());
    const int axes = state["axes"].toInt(static_cast<int>(m_look.axes));
    m_look.axes = static_cast<AxesMode>(std::clamp(axes, 0, static_cast<int>(AxesMode::None)));
    m_look.overlays = {};
    for (const OverlayEntry& entry : kOverlayTable) {
        if (state["overlays"].toArray().contains(QLatin1String(entry.key))) {
            m_look.overlays.toggle(entry.overlay);
        }
    }
    for (std::size_t i = 0; i < kSwitchKeys.size(); ++i) {
        const bool isUsual = static_cast<ViewSwitch>(i) != ViewSwitch::Interpolation;
        m_switches.at(i) = state[QLatin1String(kSwitchKeys.at(i))].toBool(isUsual);
    }
    m_look.hasScale = isSwitchedOn(ViewSwitch::Scale);
    for (int i = 0; i < kKeptViews; ++i) {
        m_keptViews.at(static_cast<std::size_t>(i)) = state["views"].toArray().at(i).toObject();
    }
    m_ownCharacters.restoreState(state["ownCharacters"].toArray());
    emit changed();
}

} // namespace posewire::gui
