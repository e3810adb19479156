#include "report_html.h"

#include <math.h>

static const char style[] =
    ":root{color-scheme:light dark;--page:#fff;--card:#f6f7f9;--ink:#1c2026;--soft:#5d6570;--line:#d9dde3;"
    "--share:#2f8fd8;--probability:#7a68d8;--shrink:#2c9c69;--negative:#d0742a}\n"
    "@media (prefers-color-scheme:dark){:root{--page:#14171c;--card:#1c2027;--ink:#e7eaee;--soft:#9aa3ae;"
    "--line:#343a43}}\n"
    "*{box-sizing:border-box}body{margin:0;background:var(--page);color:var(--ink);"
    "font:15px/1.5 system-ui,'DejaVu Sans',sans-serif}\n"
    "main{max-width:1040px;margin:0 auto;padding:28px 20px 60px}h1{font-size:24px;margin:0 0 4px}"
    "h2{font-size:17px;margin:34px 0 8px}.soft{color:var(--soft);font-size:13px;margin:4px 0}\n"
    ".lead{background:var(--card);border:1px solid var(--line);border-left:4px solid var(--share);"
    "border-radius:6px;padding:14px 18px;margin:18px 0;font-size:16px}.lead p{margin:4px 0}\n"
    "table{width:100%;border-collapse:collapse;font-size:14px}th,td{text-align:left;padding:5px 10px 5px 0;"
    "border-bottom:1px solid var(--line);vertical-align:middle}th{color:var(--soft);font-weight:500;"
    "font-size:13px}td.n,th.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}\n"
    ".bar{position:relative;display:block;height:14px;min-width:150px;background:var(--card);"
    "border:1px solid var(--line);border-radius:3px;overflow:hidden}.bar i{position:absolute;top:0;bottom:0}"
    ".bar b{position:absolute;top:5px;height:2px;background:var(--ink)}\n"
    ".share{background:var(--share)}.probability{background:var(--probability)}"
    ".shrink{background:var(--shrink)}.negative{background:var(--negative)}\n"
    "figure{margin:10px 0;background:var(--card);border:1px solid var(--line);border-radius:6px;"
    "padding:10px}figure svg{display:block;width:100%;height:auto}\n"
    ".two{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(420px,100%),1fr));gap:10px}"
    ".two figure{margin:0}.wide{overflow-x:auto}\n";

void html_begin(FILE* out, const char* title)
{
    fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n",
          out);
    html_element(out, "title", title);
    fprintf(out, "<style>\n%s</style>\n</head>\n<body>\n<main>\n", style);
}

void html_end(FILE* out)
{
    fputs("</main>\n</body>\n</html>\n", out);
}

void html_text(FILE* out, const char* text)
{
    for (; *text != '\0'; text++) {
        const unsigned char c = (unsigned char)*text;
        switch (c) {
        case '&':
            fputs("&amp;", out);
            break;
        case '<':
            fputs("&lt;", out);
            break;
        case '>':
            fputs("&gt;", out);
            break;
        case '"':
            fputs("&quot;", out);
            break;
        default:
            fputc(c < ' ' || c == 0x7f ? ' ' : c, out);
            break;
        }
    }
}

void html_element(FILE* out, const char* tag, const char* text)
{
    fprintf(out, "<%s>", tag);
    html_text(out, text);
    fprintf(out, "</%s>\n", tag);
}

static double percent(double part)
{
    return 100 * fmin(fmax(part, 0), 1);
}

void html_bar(FILE* out, const html_bar_t* bar)
{
    const double left = percent(fmin(bar->from, bar->to));
    fprintf(out, "<span class=\"bar\"><i class=\"%s\" style=\"left:%.2f%%;width:%.2f%%\"></i>", bar->kind,
            left, percent(fmax(bar->from, bar->to)) - left);
    if (bar->low <= bar->high) {
        fprintf(out, "<b style=\"left:%.2f%%;width:%.2f%%\"></b>", percent(bar->low),
                percent(bar->high) - percent(bar->low));
    }
    fputs("</span>", out);
}
