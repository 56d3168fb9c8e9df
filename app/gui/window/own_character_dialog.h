// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/widgets.h"
#include "app/gui/viewport/own_characters.h"
#include "app/gui/window/bone_table.h"

#include <QDialog>
#include <QLineEdit>
#include <QPushButton>
#include <QStringList>

#include <memory>

namespace posewire::gui {

class BodyPreview;

/// Gives characters a body of the user's own: its file, and how it stands at rest.
class OwnCharacterDialog final : public QDialog {
    Q_OBJECT

public:
    /// `names`: of the characters there are; `selected` is one of them, or empty for all.
    OwnCharacterDialog(OwnCharacters& characters, const QStringList& names, const QString& selected,
                       QWidget* parent);

    /// Reads a file, as the button does that asks for one.
    void read(const QString& path, bool isAgain = false);
    [[nodiscard]] QString stateText() const { return m_state->text(); }
    [[nodiscard]] bool isReading() const { return m_isReading; }

    void accept() override;

signals:
    void finished();

private:
    [[nodiscard]] QString who() const;
    [[nodiscard]] BodyChoice choice() const;
    void makeForm();
    void askForFile();
    void take(const ReadCharacter& file);
    void showChoice(const BodyChoice& choice);
    /// By what is chosen now.
    void makeBody();
    void correct(std::size_t mappable, const QString& bone);
    void describe();

    OwnCharacters& m_characters;
    CharacterReading m_reading;
    bool m_isReading = false;
    std::shared_ptr<const CharacterFile> m_file;
    std::shared_ptr<const DressedBody> m_body; ///< null if what is chosen makes none
    QString m_problem;                         ///< with the file or the choice; empty for none
    QLineEdit* m_path = new QLineEdit(this);
    QPushButton* m_again = new QPushButton(tr("&Read it again"), this);
    QPushButton* m_browse = new QPushButton(tr("&File…"), this);
    BodyPreview* m_preview;
    QLabel* m_state = dimText({}, this);
    QComboBox* m_unit = new ComboBox(this);
    QComboBox* m_heading = new ComboBox(this);
    QComboBox* m_rest = new ComboBox(this);
    QComboBox* m_size = new ComboBox(this);
    BoneTable* m_table = new BoneTable(this);
    std::vector<render::BoneCorrection> m_bones; ///< the operator's
    QComboBox* m_who = new ComboBox(this);
    QPushButton* m_apply = new QPushButton(tr("&Apply"), this);
    QPushButton* m_mannequin = new QPushButton(tr("Use the &mannequin"), this);
};

} // namespace posewire::gui
