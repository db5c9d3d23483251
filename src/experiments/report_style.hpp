#pragma once

namespace linewright::experiments {

/// The style sheet of the report's page, but for the charts'.
inline constexpr const char* kReportStyle = R"css(
:root{color-scheme:light dark;--bg:#fff;--ink:#18212b;--muted:#52606e;--line:#d7dde3;--soft:#f4f6f8;--link:#0b5cad;
--holds:#0a6b45;--contrary:#a8321a;--open:#6a5a12}
@media screen and (prefers-color-scheme:dark){:root{--bg:#12161b;--ink:#e9eef3;--muted:#9eabb8;--line:#323c46;
--soft:#1a2027;--link:#7db8f2;--holds:#5fd3a4;--contrary:#ff9478;--open:#e2cd73}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:1360px;padding:24px 28px 64px;background:var(--bg);color:var(--ink);
font:16px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Noto Sans","Helvetica Neue",Arial,sans-serif}
h1{font-size:30px;line-height:1.2;margin:8px 0 12px}
h2{font-size:22px;margin:52px 0 8px;padding-top:18px;border-top:2px solid var(--line)}
p{max-width:78ch;margin:8px 0}a{color:var(--link)}
nav ol{columns:2;column-gap:40px;padding-left:1.6em;max-width:110ch}
.facts{display:grid;grid-template-columns:max-content 1fr;gap:4px 18px;margin:12px 0}
.facts dt{color:var(--muted)}.facts dd{margin:0;overflow-wrap:anywhere}
.wide{overflow-x:auto;margin:18px 0}
table{border-collapse:collapse;font-size:14px;font-variant-numeric:tabular-nums}
caption{text-align:left;font-weight:650;padding:4px 0 6px;font-size:15px}
th,td{padding:4px 10px;text-align:left;vertical-align:top;border-bottom:1px solid var(--line)}
.n td{text-align:right}.n td,.n th{padding:3px 7px;font-size:13px}.n th[scope=col]{text-align:right;white-space:nowrap}
.n th[scope=col]:first-child{text-align:left}
thead th{border-bottom:2px solid var(--line);color:var(--muted);font-weight:600}
tbody th{font-weight:600;white-space:nowrap}
.s th,.s td{color:var(--muted);font-weight:400;border-bottom:none;padding-top:0;padding-bottom:2px}
.s th{padding-left:24px}
.v td:last-child{font-weight:650}.holds{color:var(--holds)}.contrary{color:var(--contrary)}.open{color:var(--open)}
.v tbody th{white-space:normal;font-weight:400}
.figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(540px,100%),1fr));gap:8px 24px}.w{grid-column:1/-1}
figure{margin:16px 0;break-inside:avoid;min-width:0}figure svg,figure img{display:block;max-width:100%;height:auto}
figcaption{color:var(--muted);font-size:14px;margin-top:6px;max-width:90ch}
@media print{:root{color-scheme:light}.figures{grid-template-columns:1fr 1fr}body{max-width:none;padding:0;font-size:11pt}
table,.n td,.n th{font-size:7pt}th,td,.n td,.n th{padding:2px 4px}caption{font-size:9pt}.wide{overflow:visible}h2{break-after:avoid}tr{break-inside:avoid}
@page{size:A4 landscape;margin:14mm}}
)css";

}  // namespace linewright::experiments
