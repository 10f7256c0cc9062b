#include "report/page_frame.h"

#include "report/text.h"

#include <algorithm>
#include <cctype>

namespace spall
{
namespace
{
// A chart has the colours of paper. On a dark screen its lightness is inverted,
// hues stay; what is printed is always light.
constexpr const char *colours = R"(
:root { color-scheme: light dark; --ink: #1c1c1c; --soft: #444; --faint: #555;
  --paper: #fff; --rule: #d8d8d8; --tint: #f6f6f6; --link: #0b5cad;
  --note: #7a4a00; --alarm: #7a0000; --alarm-rule: #a40000;
  --alarm-tint: #fff2f0; }
@media screen and (prefers-color-scheme: dark) {
  :root { --ink: #e6e6e6; --soft: #c4c4c4; --faint: #b0b0b0; --paper: #15171a;
    --rule: #3c4046; --tint: #202327; --link: #7ab8f5; --note: #e0b070;
    --alarm: #ffb4a8; --alarm-rule: #d05a4a; --alarm-tint: #33191a; }
  figure svg, .key { filter: invert(1) hue-rotate(180deg); }
  figure svg [stroke="#e4e4e4"] { stroke: #bcbcbc; }
  figure svg [stroke="#b9cfdd"] { stroke: #8fa9ba; }
  figure img { background: #fff; border-radius: 4px; } }
)";

constexpr const char *style = R"(
body { font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, Helvetica,
  Arial, sans-serif; color: var(--ink); background: var(--paper);
  max-width: 68rem; margin: 0 auto; padding: 1.5rem 1.25rem 4rem; }
h1 { font-size: 1.7rem; line-height: 1.25; margin: 0 0 .2rem;
  overflow-wrap: anywhere; }
h2 { font-size: 1.3rem; margin: 2.6rem 0 .8rem; padding-bottom: .25rem;
  border-bottom: 1px solid var(--rule); overflow-wrap: anywhere; }
h3 { font-size: 1.05rem; margin: 1.6rem 0 .5rem; }
a { color: var(--link); }
.from { color: var(--faint); margin: 0 0 1.4rem; overflow-wrap: anywhere; }
nav { margin: 1.6rem 0 0; } nav h2 { font-size: 1rem; border: 0;
  margin: 0 0 .3rem; padding: 0; }
nav ol { columns: 13rem; margin: 0; padding-left: 1.5rem; }
dl.headline { display: grid; gap: 1rem; margin: 0;
  grid-template-columns: repeat(auto-fit, minmax(min(13rem, 100%), 1fr)); }
dl.headline div { border: 1px solid var(--rule); border-radius: 6px;
  padding: .8rem 1rem; }
dl.headline dt { color: var(--soft); font-size: .95rem; }
dl.headline dd { margin: .1rem 0 0; font-size: 2rem; line-height: 1.2;
  font-variant-numeric: tabular-nums; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums;
  font-size: .95rem; }
table.headline { font-size: 1.1rem; }
th, td { text-align: left; padding: .3rem 1.4rem .3rem 0;
  border-bottom: 1px solid var(--rule); vertical-align: top; }
th { font-weight: 500; color: var(--soft); } thead th, tfoot th, tfoot td {
  font-weight: 600; color: var(--ink); }
.wide { overflow-x: auto; max-width: 100%; margin: 0 0 1.2rem; }
.charts { display: grid; gap: 1.6rem 2rem;
  grid-template-columns: repeat(auto-fill, minmax(min(26rem, 100%), 1fr)); }
figure { margin: 0 0 .6rem; max-width: 100%; min-width: 0; }
figure svg, figure img { max-width: 100%; height: auto; display: block; }
figure svg { width: 100%; }
figcaption { font-size: .9rem; color: var(--soft); margin-top: .4rem; }
.csv { font-size: .9rem; margin: .2rem 0; overflow-wrap: anywhere; }
.warnings { border: 2px solid var(--alarm-rule); border-radius: 6px;
  color: var(--alarm); background: var(--alarm-tint); padding: .6rem 1rem;
  margin: 1rem 0; }
.warnings p { margin: .2rem 0; }
.note { color: var(--note); font-size: .9rem; margin: .2rem 0; }
.key { display: inline-block; width: .8em; height: .8em; margin-right: .5em; }
details { margin: .6rem 0; } summary { cursor: pointer; }
pre { font: .8rem/1.45 ui-monospace, Menlo, Consolas, monospace;
  background: var(--tint); padding: 1rem; overflow-x: auto; max-width: 100%;
  box-sizing: border-box; }
)";

// On a phone the labels of a chart grow as the chart shrinks.
constexpr const char *media = R"(
@media (max-width: 34rem) { body { padding: 1rem .7rem 3rem; }
  dl.headline dd { font-size: 1.6rem; } th, td { padding-right: .9rem; }
  figure svg { font-size: 14px; } }
@media print { :root { color-scheme: light; }
  .key, .warnings { print-color-adjust: exact;
    -webkit-print-color-adjust: exact; }
  body { max-width: none; padding: 0; font-size: 10pt; }
  nav a, .csv { color: inherit; text-decoration: none; }
  .csv { display: none; }
  .charts { grid-template-columns: 1fr 1fr; }
  figure, tr, dl.headline div { break-inside: avoid; }
  figure img { max-height: 23cm; width: auto; }
  h2, h3 { break-after: avoid; }
  .wide, pre { overflow: visible; } pre { white-space: pre-wrap;
    overflow-wrap: anywhere; }
  details::details-content { content-visibility: visible; height: auto;
    display: block; }
  summary { list-style: none; } }
)";

std::string contents(const std::vector<PageSection> &sections)
{
  std::string out =
      "<nav aria-labelledby=\"contents\">\n<h2 id=\"contents\">Contents</h2>\n"
      "<ol>\n";
  for (const PageSection &section : sections)
    out += "<li><a href=\"#" + section.id + "\">" + escape(section.title) +
           "</a></li>\n";
  return out + "</ol>\n</nav>\n";
}
} // namespace

std::string framed_page(const PageHead &head,
                        const std::vector<PageSection> &sections)
{
  std::vector<PageSection> present;
  std::ranges::copy_if(sections, std::back_inserter(present),
                       [](const PageSection &s) { return !s.body.empty(); });
  std::string out = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n"
                    "<meta charset=\"utf-8\">\n"
                    "<meta name=\"viewport\" content=\"width=device-width, "
                    "initial-scale=1\">\n<title>" +
                    escape(head.title) + "</title>\n<style>" + colours + style +
                    media + "</style>\n</head>\n<body>\n<header>\n<h1>" +
                    escape(head.title) + "</h1>\n<p class=\"from\">" +
                    escape(head.from) + "</p>\n" + head.summary +
                    contents(present) + "</header>\n<main>\n";
  for (const PageSection &section : present)
    out += "<section id=\"" + section.id + "\">\n<h2>" + escape(section.title) +
           "</h2>\n" + section.body + "</section>\n";
  return out + "</main>\n</body>\n</html>\n";
}

std::string section_id(const std::string &title)
{
  std::string id;
  for (const unsigned char c : title)
    if (std::isalnum(c) != 0)
      id += static_cast<char>(std::tolower(c));
    else if (!id.empty() && id.back() != '-')
      id += '-';
  if (id.ends_with('-'))
    id.pop_back();
  return id.empty() ? "section" : id;
}
} // namespace spall
