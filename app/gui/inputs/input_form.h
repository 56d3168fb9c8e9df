// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/options.h"

#include <QWidget>

#include <tl/expected.hpp>

class QLabel;
class QLineEdit;
class QSpinBox;

namespace posewire::gui {

class ComboBox;

/// What the operator typed, before it is known to make sense.
struct TypedInput {
    InputAddress::Kind kind = InputAddress::Kind::Udp;
    QString host;
    int port = kDefaultPort;
    QString groups; ///< set apart by commas or spaces
};

/// The error says what is wrong with it, in a sentence. Nothing is opened or looked up.
[[nodiscard]] tl::expected<InputAddress, QString> readInput(const TypedInput& typed);

/// Protocol, host, port and multicast groups of one input, and a line that explains the protocol or says
/// what is wrong.
class InputForm final : public QWidget {
    Q_OBJECT

public:
    explicit InputForm(QWidget* parent = nullptr);

    [[nodiscard]] TypedInput typed() const;
    void setInput(const InputAddress& input);

    /// Empty for none. Stays until something is typed.
    void setProblem(const QString& problem);
    [[nodiscard]] const QString& problem() const { return m_problem; }

    void focusHost();

signals:
    /// Enter was pressed in one of the fields.
    void submitted();

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void changeKind();
    void showNote();

    ComboBox* m_protocol;
    QLineEdit* m_host;
    QSpinBox* m_port;
    QLineEdit* m_groups;
    QLabel* m_note;
    QString m_problem;
};

} // namespace posewire::gui
