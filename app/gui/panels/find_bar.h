// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/packet_choice.h"
#include "app/gui/models/packet_search.h"
#include "app/gui/theme/widgets.h"

#include <QLineEdit>
#include <QTimer>
#include <QWidget>

namespace posewire::gui {

/// A line to look for bytes or text in packets; hidden until it is asked for, Escape hides it again.
class FindBar final : public QWidget {
    Q_OBJECT

public:
    explicit FindBar(QWidget* parent = nullptr);

    /// Shows it with the keyboard in its line.
    void open();
    void setText(const QString& text) { m_edit->setText(text); }
    /// Looks for the text in packets from one on, on a thread of its own. Opens instead if there is nothing
    /// to look for, or it is wrong.
    void find(const log::PacketLog& log, const PacketModel& list, std::uint64_t from, Direction direction);
    [[nodiscard]] QString said() const { return m_answer->text(); }

signals:
    void findRequested(Direction direction);
    void found(const model::FoundBytes& bytes);
    void closed();

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    void close();
    void showKind();
    void takeResult();
    /// `isProblem` makes it red.
    void say(const QString& text, bool isProblem);

    ComboBox* m_kind = new ComboBox(this);
    QLineEdit* m_edit = new QLineEdit(this);
    QLabel* m_answer = plainLabel(this);
    std::unique_ptr<PacketSearch> m_search;
    QTimer m_poll; ///< for what the search has found
};

} // namespace posewire::gui
