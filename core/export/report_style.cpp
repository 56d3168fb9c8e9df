// SPDX-License-Identifier: MIT
#include "core/export/report_style.h"

namespace posewire::exporting {

// Curves: eight colours that people with red-green blindness can tell apart, in both themes at least 3:1
// against the ground.
std::string_view reportStyle() {
    return R"css(
:root{color-scheme:light dark;--ground:#fff;--panel:#f6f7f9;--line:#d5d9df;--text:#1b1f24;--dim:#5c6570;
--good:#1a7f37;--warning:#9a6700;--error:#c62828;
--c0:#0969da;--c1:#bc4c00;--c2:#0f7b6c;--c3:#8250df;--c4:#bf3989;--c5:#7d6400;--c6:#57606a;--c7:#116329}
@media (prefers-color-scheme:dark){:root{--ground:#16191d;--panel:#1e2227;--line:#363c44;--text:#e4e7eb;--dim:#9aa4b0;
--good:#4ac26b;--warning:#e0a63a;--error:#ff7b72;
--c0:#58a6ff;--c1:#f0883e;--c2:#3fc7b2;--c3:#bc8cff;--c4:#f778ba;--c5:#d9b93c;--c6:#a6b0bb;--c7:#56d364}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:1260px;padding:28px 24px 48px;background:var(--ground);color:var(--text);
font:15px/1.5 system-ui,"Segoe UI","Noto Sans",sans-serif;overflow-wrap:anywhere}
h1{font-size:26px;line-height:1.25;margin:0}h2{font-size:19px;margin:36px 0 10px}h3{font-size:16px;margin:22px 0 8px}
p{margin:6px 0}.dim{color:var(--dim)}
.verdict{list-style:none;margin:18px 0 0;padding:14px 18px;background:var(--panel);border:1px solid var(--line);
border-left-width:5px;border-radius:6px}
.verdict.good{border-left-color:var(--good)}.verdict.warning{border-left-color:var(--warning)}
.verdict.error{border-left-color:var(--error)}
.verdict li{display:flex;gap:10px;padding:2px 0}.verdict li:first-child{font-size:18px;font-weight:600}
.mark{flex:none;width:1.1em;text-align:center}.good>.mark,td .good{color:var(--good)}
.warning>.mark,td .warning{color:var(--warning)}.error>.mark,td .error{color:var(--error)}
.facts{display:grid;grid-template-columns:max-content 1fr;gap:2px 18px;margin:0}
.facts dt{color:var(--dim)}.facts dd{margin:0;unicode-bidi:isolate}
.plots{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(460px,100%),1fr));gap:14px}
figure{margin:0;padding:12px 14px 8px;background:var(--panel);border:1px solid var(--line);border-radius:6px}
figcaption{display:flex;flex-wrap:wrap;gap:2px 14px;align-items:baseline;font-size:13px}
.key{display:inline-flex;align-items:center;gap:6px;color:var(--dim)}
.key i{width:12px;height:4px;border-radius:2px}
svg{display:block;width:100%;height:auto;margin-top:6px}
svg text{fill:var(--dim);font:11px system-ui,"Segoe UI","Noto Sans",sans-serif;font-variant-numeric:tabular-nums}
.grid line{stroke:var(--line);stroke-width:1}
.curve{fill:none;stroke:currentColor;stroke-width:1.6;stroke-linejoin:round;vector-effect:non-scaling-stroke}
.bar{fill:currentColor}.key i{background:currentColor}
.c0{color:var(--c0)}.c1{color:var(--c1)}.c2{color:var(--c2)}.c3{color:var(--c3)}
.c4{color:var(--c4)}.c5{color:var(--c5)}.c6{color:var(--c6)}.c7{color:var(--c7)}
svg.spark{width:90px;height:18px;margin:0}
.scroll{overflow-x:auto;margin-top:10px;border:1px solid var(--line);border-radius:6px}
table{border-collapse:collapse;width:100%;font-size:13px}
th,td{padding:5px 7px;text-align:left;vertical-align:top;unicode-bidi:isolate}
th{background:var(--panel);color:var(--dim);font-weight:600;white-space:nowrap;border-bottom:1px solid var(--line)}
td:first-child{white-space:nowrap}
tr+tr td{border-top:1px solid var(--line)}
.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap;overflow-wrap:normal}
.swatch{display:inline-block;width:12px;height:12px;border-radius:3px;border:1px solid var(--line);
vertical-align:-1px;margin-right:7px}
@media print{:root{color-scheme:light;--ground:#fff;--panel:#fff;--line:#bbb;--text:#000;--dim:#444;
--good:#1a7f37;--warning:#9a6700;--error:#c62828;
--c0:#0969da;--c1:#bc4c00;--c2:#0f7b6c;--c3:#8250df;--c4:#bf3989;--c5:#7d6400;--c6:#57606a;--c7:#116329}
body{max-width:none;padding:0;font-size:11px;print-color-adjust:exact;-webkit-print-color-adjust:exact}
table{font-size:9px}th,td{padding:2px 4px}.scroll{overflow:visible;border:0}
figure,tr,.verdict{break-inside:avoid}h2,h3{break-after:avoid}thead{display:table-header-group}
.plots{grid-template-columns:1fr 1fr}}
)css";
}

} // namespace posewire::exporting
