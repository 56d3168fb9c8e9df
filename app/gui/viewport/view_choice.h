// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/own_characters.h"
#include "app/gui/viewport/view_look.h"

#include <QJsonObject>

#include <array>

namespace posewire::gui {

/// Switches of the viewport beside its axes and overlays.
enum class ViewSwitch : std::uint8_t {
    Scale,         ///< metres on the floor
    Card,          ///< the values of the segment under the pointer, else of the selected one
    Interpolation, ///< bodies glide from sample to sample, and a note says so
    RelativeViews, ///< the camera faces the shown character, else the world
};

/// What the operator chose to see and from where, kept from one run to the next. The camera that is asked for
/// is that of the active view.
class ViewChoice final : public QObject {
    Q_OBJECT

public:
    explicit ViewChoice(QObject* parent);

    [[nodiscard]] const ViewLook& look() const { return m_look; }
    [[nodiscard]] ViewLook& look() { return m_look; }
    [[nodiscard]] OwnCharacters& ownCharacters() { return m_ownCharacters; }

    void setAxes(AxesMode mode);
    [[nodiscard]] AxesMode axes() const { return m_look.axes; }
    void toggle(Overlay overlay);
    [[nodiscard]] bool isOn(Overlay overlay) const { return m_look.overlays.has(overlay); }
    void toggleSwitch(ViewSwitch which);
    [[nodiscard]] bool isSwitchedOn(ViewSwitch which) const {
        return m_switches[static_cast<std::size_t>(which)];
    }

    /// Into 1, 2 or 4 views; `heading` as in ViewPanes.
    void split(int count, float heading);
    [[nodiscard]] int viewCount() const { return m_look.panes.count(); }
    void activate(int pane);
    void activateNext() { activate((m_look.panes.active() + 1) % viewCount()); }

    void toggleProjection();
    [[nodiscard]] render::Projection projection() const { return m_look.panes.motion().camera().projection; }
    void face(render::StandardView view, float heading);
    /// The camera moves as by the mouse, in steps: around its target, beside it, and closer.
    void orbitBy(int right, int up);
    void panBy(int right, int up);
    void zoomBy(int steps);
    /// Keeps how the camera looks now as one of kKeptViews views, or looks like that again if one was kept.
    static constexpr int kKeptViews = 4;
    void keepView(int index) {
        m_keptViews.at(static_cast<std::size_t>(index)) = stateOf(m_look.panes.motion());
    }
    void showKeptView(int index);
    [[nodiscard]] bool isKept(int index) const {
        return !m_keptViews.at(static_cast<std::size_t>(index)).isEmpty();
    }

    [[nodiscard]] QJsonObject state() const;
    void restoreState(const QJsonObject& state);

signals:
    /// Axes, overlays, switches, views or projection.
    void changed();
    /// A camera alone.
    void cameraMoved();

private:
    ViewLook m_look;
    OwnCharacters m_ownCharacters;
    std::array<bool, 4> m_switches{true, true, false, true}; ///< by ViewSwitch
    std::array<QJsonObject, kKeptViews> m_keptViews;         ///< as by stateOf(); empty if none was kept
};

} // namespace posewire::gui
