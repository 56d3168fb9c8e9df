// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/panel.h"
#include "app/gui/models/metadata_model.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/theme/widgets.h"

class QActionGroup;

namespace posewire::gui {

/// Below the metadata: what the operator declares about the sender instead of what was detected, and what
/// contradicts that or itself.
class DetectionBar : public QWidget {
    Q_OBJECT

public:
    DetectionBar(model::SessionView& view, Commands& commands, QWidget* parent);

    /// `sender` is whom the choices are about; without one the bar is hidden.
    void showSender(std::optional<log::SenderId> sender);
    [[nodiscard]] model::SenderOverride declared() const;
    /// Nothing happens where none is shown.
    void declare(const model::SenderOverride& overrides);

private:
    struct Choice {
        QToolButton* button;
        QActionGroup* group;
    };

    template <class Value>
    Choice addChoice(const QString& toolTip, std::optional<Value> model::SenderOverride::*declared,
                     const std::vector<std::pair<QString, std::optional<Value>>>& values);
    void showContradictions(const model::Sender& sender);

    model::SessionView& m_view;
    Commands& m_commands;
    std::optional<log::SenderId> m_sender;
    QLabel* m_contradictions = plainLabel(this);
    Choice m_revision;
    Choice m_unit;
    Choice m_up;
};

/// Dock `metadata`: every tag of the shown character, and what was concluded about its sender.
class MetadataPanel : public Panel {
    Q_OBJECT

public:
    MetadataPanel(model::SessionView& view, Commands& commands, QWidget* parent);

    [[nodiscard]] static std::span<const ActionInfo> actionTable();

    void refresh() override;
    [[nodiscard]] QString summary() const override;
    [[nodiscard]] DetectionBar& detection() const { return *m_detection; }

private:
    MetadataModel m_model{m_view};
    TableView* m_table = new TableView(tr("Metadata"), this);
    DetectionBar* m_detection = new DetectionBar(m_view, m_commands, this);
};

} // namespace posewire::gui
