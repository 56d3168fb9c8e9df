// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/metadata_panel.h"

#include "app/gui/models/shown_character.h"

#include <QVBoxLayout>

namespace posewire::gui {

MetadataPanel::MetadataPanel(model::SessionView& view, Commands& commands, QWidget* parent)
    : Panel(parent),
      m_view(view),
      m_model(view),
      m_table(new TableView(tr("Metadata"), this)),
      m_detection(new DetectionBar(view, commands, this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins({});
    layout->setSpacing(0);
    layout->addWidget(m_table, 1);
    layout->addWidget(m_detection);
    m_table->setModel(&m_model);
    m_table->setRootIsDecorated(true);
    m_table->setColumnSamples({QStringLiteral("name · 22 changes"), QString(), QStringLiteral("99 min")});
    m_table->setEmptyText(
        tr("No character selected.\nMetadata (type 12) appears here as soon as a character arrives."));
    connect(m_table, &TableView::copyRequested, this,
            [&commands](const QString& text) { commands.copyText(text); });
}

void MetadataPanel::refresh() {
    m_model.refresh();
    const auto key = shownCharacter(m_view);
    m_detection->showSender(key ? std::optional(key->sender) : std::nullopt);
}

QString MetadataPanel::summary() const {
    const auto key = shownCharacter(m_view);
    return key ? characterName(m_view, *key) : QString();
}

} // namespace posewire::gui
