// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/metadata_model.h"
#include "app/gui/panel.h"
#include "app/gui/panels/detection_bar.h"
#include "app/gui/panels/table_view.h"

namespace posewire::gui {

/// Dock `metadata`: every tag of the shown character, and what was concluded about its sender.
class MetadataPanel : public Panel {
    Q_OBJECT

public:
    MetadataPanel(model::SessionView& view, Commands& commands, QWidget* parent);

    void refresh() override;
    [[nodiscard]] QString summary() const override;

private:
    model::SessionView& m_view;
    MetadataModel m_model;
    TableView* m_table;
    DetectionBar* m_detection;
};

} // namespace posewire::gui
