// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/commands.h"
#include "app/gui/models/character_model.h"
#include "app/gui/panels/table_view.h"

#include <QFrame>

namespace posewire::gui {

/// "Lost 12 of 2 400 samples in the last 10 s."
[[nodiscard]] QString lossText(model::SessionView& session, const model::CharacterKey& key);

/// Says above `anchor` why a character is as it is, until a click elsewhere or Escape.
QWidget* showHealthPopup(model::SessionView& session, Commands& commands, const model::CharacterKey& key,
                         QWidget& anchor);

/// All characters in a list above the bottom line, the worst first. Deletes itself when it is closed: by a
/// choice, a click elsewhere or Escape.
class HealthList final : public QFrame {
    Q_OBJECT

public:
    HealthList(model::SessionView& session, Commands& commands, QWidget* parent);

    void showAt(const QWidget& anchor);
    void refresh() { m_model.refresh(); }

signals:
    void chosen(const model::CharacterKey& key);

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    CharacterModel m_model;
    TableView* m_table = new TableView(tr("All characters"), this);
};

} // namespace posewire::gui
