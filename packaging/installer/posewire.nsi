; SPDX-License-Identifier: GPL-3.0-or-later
; The installer for Windows, by NSIS 3. packaging/windows gives it VERSION, NUMBERS (the version as four numbers), STAGE (the folder
; of what is installed), REMOVALS (a file that removes each of that again), OUTPUT and KILOBYTES.
; Silent: setup.exe /S [/AllUsers|/CurrentUser] [/FIREWALL=0|1] [/D=FOLDER]
Unicode true
Target amd64-unicode
ManifestDPIAware true
SetCompressor /SOLID lzma
SetDateSave off
Name "Posewire ${VERSION}"
OutFile "${OUTPUT}"
BrandingText "Posewire ${VERSION}"
VIProductVersion "${NUMBERS}"
VIAddVersionKey ProductName "Posewire"
VIAddVersionKey ProductVersion "${VERSION}"
VIAddVersionKey FileVersion "${VERSION}"
VIAddVersionKey FileDescription "Posewire setup"
VIAddVersionKey CompanyName "The Posewire authors"
VIAddVersionKey LegalCopyright "The Posewire authors, GPL-3.0-or-later"

!define UNINSTALL_KEY "Software\Microsoft\Windows\CurrentVersion\Uninstall\Posewire"
!define RULE "Posewire"
!define MULTIUSER_EXECUTIONLEVEL Highest
!define MULTIUSER_MUI
!define MULTIUSER_INSTALLMODE_COMMANDLINE
!define MULTIUSER_USE_PROGRAMFILES64
!define MULTIUSER_INSTALLMODE_INSTDIR "Posewire"
!define MULTIUSER_INSTALLMODE_INSTDIR_REGISTRY_KEY "${UNINSTALL_KEY}"
!define MULTIUSER_INSTALLMODE_INSTDIR_REGISTRY_VALUENAME "InstallLocation"
!define MULTIUSER_INSTALLMODE_DEFAULT_REGISTRY_KEY "${UNINSTALL_KEY}"
!define MULTIUSER_INSTALLMODE_DEFAULT_REGISTRY_VALUENAME "InstallLocation"
!include MultiUser.nsh
!include MUI2.nsh
!include FileFunc.nsh
!include LogicLib.nsh
!include Sections.nsh

!define MUI_ICON "${ICON}"
!define MUI_UNICON "${ICON}"
!define MUI_ABORTWARNING
!define MUI_FINISHPAGE_RUN "$INSTDIR\posewire.exe"
!insertmacro MUI_PAGE_LICENSE "${STAGE}\licences\GPL-3.0-or-later.txt"
!insertmacro MULTIUSER_PAGE_INSTALLMODE
!insertmacro MUI_PAGE_COMPONENTS
!insertmacro MUI_PAGE_DIRECTORY
!insertmacro MUI_PAGE_INSTFILES
!insertmacro MUI_PAGE_FINISH
!insertmacro MUI_UNPAGE_CONFIRM
!insertmacro MUI_UNPAGE_INSTFILES
!insertmacro MUI_LANGUAGE "English"

; A program that runs cannot be replaced.
!macro WAIT_FOR_PROGRAM un
Function ${un}waitForProgram
  again:
  ${IfNot} ${FileExists} "$INSTDIR\posewire.exe"
    Return
  ${EndIf}
  ClearErrors
  FileOpen $0 "$INSTDIR\posewire.exe" a
  ${If} ${Errors}
    MessageBox MB_RETRYCANCEL|MB_ICONEXCLAMATION "Posewire is running. Close it to continue." /SD IDCANCEL IDRETRY again
    SetErrorLevel 3
    Quit
  ${EndIf}
  FileClose $0
FunctionEnd
!macroend
!insertmacro WAIT_FOR_PROGRAM ""
!insertmacro WAIT_FOR_PROGRAM "un."

Section "Posewire" MAIN
  SectionIn RO
  Call waitForProgram
  ${If} ${FileExists} "$INSTDIR\uninstall.exe" ; so that no file of an earlier version stays
    ExecWait '"$INSTDIR\uninstall.exe" /S /$MultiUser.InstallMode _?=$INSTDIR'
  ${EndIf}
  SetOutPath "$INSTDIR"
  File /r "${STAGE}\*"
  WriteUninstaller "$INSTDIR\uninstall.exe"
  WriteRegStr SHCTX "${UNINSTALL_KEY}" "DisplayName" "Posewire"
  WriteRegStr SHCTX "${UNINSTALL_KEY}" "DisplayVersion" "${VERSION}"
  WriteRegStr SHCTX "${UNINSTALL_KEY}" "DisplayIcon" "$INSTDIR\posewire.exe"
  WriteRegStr SHCTX "${UNINSTALL_KEY}" "Publisher" "The Posewire authors"
  WriteRegStr SHCTX "${UNINSTALL_KEY}" "InstallLocation" "$INSTDIR"
  WriteRegStr SHCTX "${UNINSTALL_KEY}" "UninstallString" '"$INSTDIR\uninstall.exe" /$MultiUser.InstallMode'
  WriteRegStr SHCTX "${UNINSTALL_KEY}" "QuietUninstallString" '"$INSTDIR\uninstall.exe" /S /$MultiUser.InstallMode'
  WriteRegDWORD SHCTX "${UNINSTALL_KEY}" "EstimatedSize" ${KILOBYTES}
  WriteRegDWORD SHCTX "${UNINSTALL_KEY}" "NoModify" 1
  WriteRegDWORD SHCTX "${UNINSTALL_KEY}" "NoRepair" 1
SectionEnd

Section "Entries in the Start menu" MENU
  CreateDirectory "$SMPROGRAMS\Posewire"
  CreateShortcut "$SMPROGRAMS\Posewire\Posewire.lnk" "$INSTDIR\posewire.exe"
  CreateShortcut "$SMPROGRAMS\Posewire\User guide.lnk" "$INSTDIR\guide\index.html"
SectionEnd

; Programs that open these files by default stay what they are.
Section "Open with: pcapng, pcap, mvnx" TYPES
  WriteRegStr SHCTX "Software\Classes\Posewire.Recording" "" "Motion-capture recording"
  WriteRegStr SHCTX "Software\Classes\Posewire.Recording\DefaultIcon" "" "$INSTDIR\posewire.exe,0"
  WriteRegStr SHCTX "Software\Classes\Posewire.Recording\shell\open\command" "" '"$INSTDIR\posewire.exe" "%1"'
  WriteRegStr SHCTX "Software\Classes\.pcapng\OpenWithProgids" "Posewire.Recording" ""
  WriteRegStr SHCTX "Software\Classes\.pcap\OpenWithProgids" "Posewire.Recording" ""
  WriteRegStr SHCTX "Software\Classes\.mvnx\OpenWithProgids" "Posewire.Recording" ""
  System::Call 'shell32::SHChangeNotify(i 0x08000000, i 0, p 0, p 0)'
SectionEnd

; Only for all users: Windows asks administrators alone, and a user's own start of Posewire is asked for by Windows itself.
Section "Let senders through Windows Firewall" FIREWALL
  ${If} $MultiUser.InstallMode == "AllUsers"
    nsExec::ExecToStack 'netsh advfirewall firewall delete rule name="${RULE}"'
    Pop $0
    Pop $1
    nsExec::ExecToStack 'netsh advfirewall firewall add rule name="${RULE}" dir=in action=allow program="$INSTDIR\posewire.exe"'
    Pop $0
    Pop $1
    nsExec::ExecToStack 'netsh advfirewall firewall add rule name="${RULE}" dir=in action=allow program="$INSTDIR\posewire-cli.exe"'
    Pop $0
    Pop $1
    WriteRegDWORD SHCTX "${UNINSTALL_KEY}" "HasFirewallRule" 1
  ${EndIf}
SectionEnd

!insertmacro MUI_FUNCTION_DESCRIPTION_BEGIN
  !insertmacro MUI_DESCRIPTION_TEXT ${MAIN} "The window, posewire-cli and the user guide."
  !insertmacro MUI_DESCRIPTION_TEXT ${MENU} "Posewire and its guide in the Start menu."
  !insertmacro MUI_DESCRIPTION_TEXT ${TYPES} "Offers Posewire for recordings. Their usual program stays what it is."
  !insertmacro MUI_DESCRIPTION_TEXT ${FIREWALL} "Without it Windows asks when Posewire first receives, or silently drops what arrives."
!insertmacro MUI_FUNCTION_DESCRIPTION_END

Function .onInit
  StrCpy $2 $INSTDIR ; of /D=, which the next line would forget
  !insertmacro MULTIUSER_INIT
  ${If} $2 != ""
    StrCpy $INSTDIR $2
  ${EndIf}
  ${GetParameters} $0
  ClearErrors
  ${GetOptions} $0 "/FIREWALL=" $1
  ${If} $1 == "0"
    !insertmacro UnselectSection ${FIREWALL}
  ${EndIf}
FunctionEnd

Function un.onInit
  !insertmacro MULTIUSER_UNINIT
FunctionEnd

!macro FORGET_TYPE suffix
  DeleteRegValue SHCTX "Software\Classes\.${suffix}\OpenWithProgids" "Posewire.Recording"
  DeleteRegKey /ifempty SHCTX "Software\Classes\.${suffix}\OpenWithProgids"
  DeleteRegKey /ifempty SHCTX "Software\Classes\.${suffix}"
!macroend

Section "Uninstall"
  Call un.waitForProgram
  ReadRegDWORD $0 SHCTX "${UNINSTALL_KEY}" "HasFirewallRule"
  ${If} $0 == 1
    nsExec::ExecToStack 'netsh advfirewall firewall delete rule name="${RULE}"'
    Pop $0
    Pop $1
  ${EndIf}
  !include "${REMOVALS}"
  Delete "$INSTDIR\uninstall.exe"
  RMDir "$INSTDIR"
  Delete "$SMPROGRAMS\Posewire\Posewire.lnk"
  Delete "$SMPROGRAMS\Posewire\User guide.lnk"
  RMDir "$SMPROGRAMS\Posewire"
  !insertmacro FORGET_TYPE pcapng
  !insertmacro FORGET_TYPE pcap
  !insertmacro FORGET_TYPE mvnx
  DeleteRegKey SHCTX "Software\Classes\Posewire.Recording"
  DeleteRegKey SHCTX "${UNINSTALL_KEY}"
  System::Call 'shell32::SHChangeNotify(i 0x08000000, i 0, p 0, p 0)'
SectionEnd
