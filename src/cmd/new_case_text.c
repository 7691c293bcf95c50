/* Writes the text of a new case. SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/new_case.h"
#include "core/base/text.h"

#include <string.h>

/* ---- names in XML ---------------------------------------------------------------------------- */

/* True for U+FFFE and U+FFFF: well-formed UTF-8, but not allowed in XML. */
static bool is_xml_noncharacter(const char *text)
{
    return strncmp(text, "\xEF\xBF\xBE", 3) == 0 || strncmp(text, "\xEF\xBF\xBF", 3) == 0;
}

const char *new_case_name_problem(const char *name)
{
    const size_t n = strlen(name);
    if (utf8_valid_length(name, n) < n)
        return "bytes that are not UTF-8";
    for (const char *p = name; *p != '\0'; p++) {
        if ((unsigned char)*p < ' ' || *p == 0x7f)
            return "a control character";
        if (is_xml_noncharacter(p))
            return "a character that XML does not have";
    }
    return n > 0 && (name[0] == ' ' || name[n - 1] == ' ') ? "a blank at its beginning or end"
                                                           : NULL;
}

static void write_xml_text(FILE *out, const char *text)
{
    static const char marks[] = "&<>\"";
    static const char *const names[] = {"&amp;", "&lt;", "&gt;", "&quot;"};
    for (const char *p = text; *p != '\0'; p++) {
        const char *const mark = strchr(marks, *p);
        if (mark != NULL)
            fputs(names[mark - marks], out);
        else
            putc(*p, out);
    }
}

/* Writes a comment, in which two adjacent hyphens are not allowed. */
static void write_comment(FILE *out, const char *text)
{
    const size_t length = strlen(text);
    for (size_t i = 0, n; i<length; i += n> 0 ? n : 1) {
        n = utf8_character_length(text + i, length - i);
        if (n == 0 || (unsigned char)text[i] < ' ' || is_xml_noncharacter(text + i))
            putc('?', out);
        else if (!(text[i] == '-' && i > 0 && text[i - 1] == '-'))
            fwrite(text + i, 1, n, out);
    }
}

size_t new_case_count(const new_case *c, case_section where)
{
    size_t n = 0;
    for (size_t i = 0; i < c->n; i++)
        n += c->entries[i].case_section == where;
    return n;
}

/* ---- sections ------------------------------------------------------------------------------ */

/* Writes the reason for the group of a file of force curves. */
static void write_reason(FILE *out, const case_entry *e)
{
    if (e->case_section > TRACK)
        return;
    if (e->word == NULL)
        fputs("; bulk is a guess: no name says bulk or track", out);
    else
        fprintf(out, "; %s by \"%s\" in the name of the %s",
                e->case_section == BULK ? "bulk" : "track", e->word,
                e->from_folder ? "folder" : "file");
}

/* Writes placeholders for units of columns without one. */
static void write_units(FILE *out, const char *names)
{
    for (size_t k = 0, n; *names != '\0'; names += n + (names[n] != '\0'), k++) {
        char name[sizeof((file_kind *)0)->unitless];
        n = strcspn(names, "\n");
        snprintf(name, sizeof name, "%.*s", (int)n, names);
        fputs(k == 0 ? " units=\"" : ";", out);
        write_xml_text(out, name);
        fputs("=" FILL_IN, out);
        if (names[n] == '\0' || names[n + 1] == '\0')
            putc('"', out);
    }
}

static void write_file_element(FILE *out, const case_entry *e, const char *indent,
                               const char *element)
{
    fprintf(out, "%s<%s", indent, element);
    for (size_t k = 0; k < FILE_KIND_N_MISSING; k++)
        if (file_kind_is_missing(&e->found, k))
            fprintf(out, " %s=\"" FILL_IN "\"", file_kind_missing_rows[k].name);
    write_units(out, e->found.unitless);
    putc('>', out);
    write_xml_text(out, e->in_case);
    fprintf(out, "</%s>\n", element);
}

static void write_file_elements(FILE *out, const new_case *c, case_section where,
                                const char *element)
{
    const char *indent = where == BULK || where == TRACK ? "      " : "    ";
    const case_entry *last = NULL; /* equal comments appear once */
    for (size_t i = 0; i < c->n; i++) {
        const case_entry *e = &c->entries[i];
        if (e->case_section != where)
            continue;
        if (last == NULL || strcmp(last->found.description, e->found.description) != 0 ||
            last->word != e->word || last->from_folder != e->from_folder) {
            fprintf(out, "%s<!-- ", indent);
            write_comment(out, e->found.description);
            write_reason(out, e);
            fputs(" -->\n", out);
        }
        last = e;
        write_file_element(out, e, indent, element);
    }
}

/* Writes an element that occurs once; other candidates are comments. */
static void write_single_element(FILE *out, const new_case *c, case_section where,
                                 const char *element)
{
    const case_entry *first = NULL;
    for (size_t i = 0; i < c->n; i++) {
        const case_entry *e = &c->entries[i];
        if (e->case_section != where)
            continue;
        fputs(first == NULL ? "    <!-- "
                            : "    <!-- to have this one, too, name a folder of all: ",
              out);
        write_comment(out, first == NULL ? e->found.description : e->path);
        fputs(" -->\n", out);
        if (first == NULL)
            write_file_element(out, e, "    ", element);
        first = first != NULL ? first : e;
    }
}

/* Writes the files of a section between two lines; false if there are none. */
static bool write_section(FILE *out, const new_case *c, case_section where, const char *begin,
                          const char *element, const char *end)
{
    if (new_case_count(c, where) == 0)
        return false;
    fputs(begin, out);
    write_file_elements(out, c, where, element);
    fputs(end, out);
    return true;
}

static void write_indentation(FILE *out, const new_case *c)
{
    if (new_case_count(c, TRACK) + new_case_count(c, BULK) == 0) {
        fputs("\n  <!-- no force curves: no section indentation -->\n", out);
        return;
    }
    fputs("\n  <indentation>\n    <!-- sphere:radius=5um, pyramid:half-angle=20deg,radius=20nm ... "
          "-->\n    <tip>",
          out);
    write_xml_text(out, c->tip != NULL ? c->tip : FILL_IN);
    fputs("</tip>\n", out);
    write_section(out, c, BULK, "    <bulk>\n", "files", "    </bulk>\n");
    write_section(out, c, TRACK, "    <track>\n", "files", "    </track>\n");
    fputs("  </indentation>\n", out);
}

static void write_dma(FILE *out, const new_case *c)
{
    if (!write_section(
            out, c, DMA,
            "\n  <dma>\n    <!-- <reference-temperature>20degC</reference-temperature>, else "
            "that of the middle isotherm -->\n",
            "files", "  </dma>\n"))
        fputs("\n  <!-- no DMA sweeps: no section dma -->\n", out);
}

static void write_roughness(FILE *out, const new_case *c)
{
    if (new_case_count(c, ROUGHNESS) == 1) {
        write_section(out, c, ROUGHNESS, "\n  <roughness>\n    <spectrum>\n", "file",
                      "    </spectrum>\n  </roughness>\n");
        return;
    }
    if (write_section(out, c, MAPS,
                      "\n  <roughness>\n    <!-- Maps and profiles of the counter surface, of "
                      "several places at best; no images of spots. -->\n",
                      "files", "  </roughness>\n"))
        return;
    fputs("\n  <!-- Counter surface; for friction:\n  <roughness>\n    <self-affine>\n"
          "      <q0>" FILL_IN ", such as 2e3rad/m</q0>\n"
          "      <q1>" FILL_IN ", such as 2e6rad/m</q1>\n"
          "      <hurst>" FILL_IN ", such as 0.8</hurst>\n"
          "      <c0>" FILL_IN ", such as 2e-17m^4</c0>\n"
          "    </self-affine>\n  </roughness> -->\n",
          out);
    for (size_t i = 0; i < c->n; i++)
        if (c->entries[i].case_section == ROUGHNESS) {
            fputs("  <!-- one of several spectra: ", out);
            write_comment(out, c->entries[i].path);
            fputs(" -->\n", out);
        }
}

static void write_record_section(FILE *out, const new_case *c)
{
    if (new_case_count(c, RECORD) == 0)
        return;
    fputs("\n  <record>\n", out);
    write_single_element(out, c, RECORD, "files");
    bool lacks_load = false;
    for (size_t i = 0; i < c->n; i++) {
        const case_entry *e = &c->entries[i];
        lacks_load |= e->case_section == RECORD && e->found.has_force && !e->found.has_load;
    }
    if (lacks_load)
        fputs("    <load>" FILL_IN "</load>\n", out);
    if (new_case_count(c, PROFILE) > 0)
        fputs("    <!-- across the track, by the name of the file or folder -->\n", out);
    write_single_element(out, c, PROFILE, "profile");
    fprintf(out,
            "    <!-- Where the files do not say it, and for wear and the pressure of a ball:\n%s"
            "    <track-radius>" FILL_IN ", such as 5mm</track-radius>\n"
            "    <ball-radius>" FILL_IN ", such as 5mm</ball-radius>\n"
            "    <modulus>" FILL_IN ", of the rubber, such as 20MPa</modulus> -->\n  </record>\n",
            lacks_load ? "" : "    <load>" FILL_IN ", such as 5N</load>\n");
}

static void write_unused(FILE *out, const case_entry *e)
{
    fputs("  <!-- not used: ", out);
    write_comment(out, e->path);
    fputs(": ", out);
    write_comment(out, e->found.description);
    fputs(e->found.kind == WT_KIND_IMAGE ? "; an image: of the counter surface it goes into "
                                           "roughness as files, across a track into record as "
                                           "profile, of a spot see weartrack spot"
          : e->found.is_result           ? "; a result of weartrack"
                                         : "",
          out);
    fputs(" -->\n", out);
}

static void write_remaining_sections(FILE *out, const new_case *c)
{
    fputs("\n  <!-- For friction:\n  <sliding>\n"
          "    <pressure>" FILL_IN ", such as 0.4MPa</pressure>\n"
          "    <velocity>" FILL_IN ", such as 1e-4:10m/s:log:31</velocity>\n"
          "    <temperature>" FILL_IN ", such as 30degC</temperature>\n"
          "    <shear-stress>" FILL_IN ", such as 5MPa; may be left out</shear-stress>\n"
          "  </sliding> -->\n"
          "\n  <!-- For the thickness of the layer, with one of the last two:\n  <layer>\n"
          "    <specific-wear-rate>" FILL_IN
          ", such as 1e-3mm^3/(N m); may be left out if a record has the "
          "wear</specific-wear-rate>\n    <critical-energy>" FILL_IN
          ", such as 2e10J/m^3</critical-energy>\n"
          "    <observed-thickness>" FILL_IN ", such as 3um</observed-thickness>\n"
          "  </layer> -->\n",
          out);
    write_record_section(out, c);
    if (new_case_count(c, BULK) > 0 && new_case_count(c, TRACK) > 0)
        fprintf(out, "\n  <compare>\n    <track-to-bulk/>\n    <by-rate/>\n%s  </compare>\n",
                new_case_count(c, DMA) > 0 ? "    <indentation-to-dma/>\n" : "");
    for (size_t i = 0; i < c->n; i++)
        if (c->entries[i].case_section == UNUSED)
            write_unused(out, &c->entries[i]);
}

void new_case_write(FILE *out, const new_case *c)
{
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
          "<!-- What stands here as " FILL_IN " is in no file: put the value there, with its "
          "unit. Then:\n     weartrack run with the name of this file. See weartrack-case(5). "
          "-->\n<case version=\"1\">\n  <!-- <title>what the report is called</title> -->\n",
          out);
    write_indentation(out, c);
    write_dma(out, c);
    write_roughness(out, c);
    write_remaining_sections(out, c);
    fputs("</case>\n", out);
}
