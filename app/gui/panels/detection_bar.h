// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/commands.h"
#include "core/model/session/session_view.h"

#include <QToolButton>
#include <QWidget>

#include <functional>
#include <optional>

class QActionGroup;
class QLabel;

namespace posewire::gui {

/// Below the metadata: what the operator declares about the sender instead of what was detected, and what
/// contradicts that or itself.
class DetectionBar : public QWidget {
    Q_OBJECT

public:
    DetectionBar(model::SessionView& view, Commands& commands, QWidget* parent);

    /// `sender` is whom the choices are about; without one the bar is hidden.
    void showSender(std::optional<log::SenderId> sender);

private:
    QToolButton* addButton(const QString& toolTip, QActionGroup*& group);
    void addRevision(const QString& text, std::optional<model::Revision> revision);
    void addUnit(const QString& text, std::optional<model::LengthUnit> unit);
    void declare(const std::function<void(model::SenderOverride&)>& change);
    void showContradictions(const model::Sender& sender);

    model::SessionView& m_view;
    Commands& m_commands;
    std::optional<log::SenderId> m_sender;
    QLabel* m_contradictions;
    QActionGroup* m_revisions = nullptr;
    QActionGroup* m_units = nullptr;
    QToolButton* m_revision;
    QToolButton* m_unit;
};

} // namespace posewire::gui
