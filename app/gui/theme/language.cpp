// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/language.h"

#include <QCoreApplication>
#include <QDir>
#include <QLibraryInfo>
#include <QLocale>
#include <QRegularExpression>
#include <QTranslator>

namespace posewire::gui {

namespace {

QString catalogues() {
    return QStringLiteral(":/translations");
}

/// Has all texts in one context.
class Catalogue : public QTranslator {
public:
    using QTranslator::QTranslator;

    [[nodiscard]] QString translate(const char* /*context*/, const char* source, const char* about,
                                    int number) const override {
        return QTranslator::translate("posewire", source, about, number);
    }
};

/// Doubles and accents vowels, about 40 % of a text. Placeholders, tags, entities and mnemonics stay.
class PseudoTranslator : public Catalogue {
public:
    using Catalogue::Catalogue;

    [[nodiscard]] bool isEmpty() const override { return false; }

    [[nodiscard]] QString translate(const char* context, const char* source, const char* about,
                                    int number) const override {
        static const QRegularExpression kKept(
            QStringLiteral("</?[a-z][^>]*>|&[a-z]+;|&.|%L?[\\dn]|\\{[^}]*\\}"),
            QRegularExpression::CaseInsensitiveOption);
        static const QString kPlain = QStringLiteral("aeiouyAEIOUY");
        static const QString kAccented = QStringLiteral("áéíóúýÁÉÍÓÚÝ");
        const QString english = Catalogue::translate(context, source, about, number);
        const QString text = english.isEmpty() ? QString::fromUtf8(source) : english;
        QString pseudo;
        for (qsizetype at = 0; at < text.size();) {
            const auto kept = kKept.match(text, at, QRegularExpression::NormalMatch,
                                          QRegularExpression::AnchorAtOffsetMatchOption);
            const qsizetype length = kept.hasMatch() ? kept.capturedLength() : 1;
            const QStringView part = QStringView(text).mid(at, length);
            const bool isMnemonic = length == 2 && part[0] == u'&';
            const qsizetype vowel = isMnemonic || !kept.hasMatch() ? kPlain.indexOf(part.back()) : -1;
            pseudo += vowel < 0 || isMnemonic ? part.toString() : QString(kAccented[vowel]);
            pseudo += vowel < 0 ? QString() : QString(kAccented[vowel]);
            at += length;
        }
        return pseudo;
    }
};

template <class Translator, class... Place>
bool install(const Place&... place) {
    auto* translator = new Translator(QCoreApplication::instance());
    return translator->load(place...) && QCoreApplication::installTranslator(translator);
}

} // namespace

QStringList languages() {
    QStringList codes;
    for (const QString& file : QDir(catalogues()).entryList()) {
        codes += file.section(u'_', 1).section(u'.', 0, 0);
    }
    return codes;
}

void useLanguage(const QString& code) {
    const QString english = QStringLiteral("posewire_en"); // below all others, for its plurals
    if (code == QLatin1String(kPseudoLanguage)) {
        install<PseudoTranslator>(english, catalogues());
        return;
    }
    install<Catalogue>(english, catalogues());
    const QLocale locale = code.isEmpty() ? QLocale() : QLocale(code);
    if (install<Catalogue>(locale, QStringLiteral("posewire"), QStringLiteral("_"), catalogues())) {
        install<QTranslator>(locale, QStringLiteral("qtbase"), QStringLiteral("_"),
                             QLibraryInfo::path(QLibraryInfo::TranslationsPath));
    }
}

} // namespace posewire::gui
