// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/driver/relaying.h"
#include "app/gui/inputs/undo_removal.h"
#include "app/gui/models/receiving_models.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/theme/widgets.h"

#include <QLineEdit>
#include <QPushButton>
#include <QWidget>

namespace posewire::gui {

/// The hosts that every datagram is forwarded to, with what they got; adds, switches and removes them.
class RelayPage final : public QWidget {
    Q_OBJECT

public:
    explicit RelayPage(Relaying& relaying, QWidget* parent = nullptr);

    void refresh();

    void submit();
    void removeSelected(); ///< until it is undone

    [[nodiscard]] const QString& problem() const { return m_problem; }
    [[nodiscard]] RelayModel& model() { return m_model; }

signals:
    void choicesChanged();

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    void layOut();
    void remove(const RelayChoice& choice);
    void putBack(const RelayChoice& choice, std::size_t row);
    void switchTarget(int row, bool isOn);
    void setProblem(const QString& problem);
    void showNote();

    Relaying& m_relaying;
    RelayModel m_model;
    TableView* m_table = new TableView(tr("Relay targets"), this);
    QLineEdit* m_target = new QLineEdit(this);
    Note* m_note = new Note(this);
    QPushButton* m_add = new QPushButton(tr("&Add target"), this);
    QPushButton* m_remove = new QPushButton(tr("&Remove"), this);
    UndoRemoval* m_undo = new UndoRemoval(this);
    QString m_problem;
};

/// "HOST:PORT", "HOST" for the port that MVN uses, "[IPv6]:PORT"; the error is a sentence.
[[nodiscard]] tl::expected<RelayChoice, QString> readRelay(const QString& text);

} // namespace posewire::gui
