/* weartrack formats: list, show, check. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "cmd/cmd.h"

static int list_formats(const wt_formats *formats)
{
    for (size_t i = 0; i < wt_formats_count(formats); i++) {
        const wt_format_info *f = wt_formats_get(formats, i);
        static const struct {
            unsigned bit;
            const char *word;
        } kinds[] = {{WT_KIND_FORCE, "force curves"},
                     {WT_KIND_SWEEP, "DMA sweeps"},
                     {WT_KIND_IMAGE, "images"},
                     {WT_KIND_SPECTRUM, "spectra"}};
        char holds[80] = "";
        size_t used = 0;
        for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++)
            if (f->kinds & kinds[k].bit)
                used += (size_t)snprintf(holds + used, sizeof holds - used, "%s%s",
                                         used > 0 ? ", " : "", kinds[k].word);
        enum { INDENT = 6 };
        printf("%s%-18s %-22s %s\n%*s", i > 0 ? "\n" : "", f->id, holds,
               f->verified ? "verified" : "not verified on a measured file", INDENT, "");
        cmd_wrap(stdout, INDENT, INDENT, f->title);
        if (f->evidence != NULL && *f->evidence != '\0') {
            printf("%*s", INDENT, "");
            cmd_wrap(stdout, INDENT, INDENT, f->evidence);
        }
    }
    return CMD_OK;
}

static int show_format(const wt_formats *formats, const char *id)
{
    if (strcmp(id, "schema") == 0) {
        fputs(wt_formats_schema(), stdout);
        return CMD_OK;
    }
    const char *xml = wt_formats_xml(formats, id);
    if (xml != NULL) {
        fputs(xml, stdout);
        return CMD_OK;
    }
    const wt_format_info *f = wt_formats_find(formats, id);
    if (f != NULL) {
        printf("%s: %s\nread by the program itself; there is no description to show\n", f->id,
               f->title);
        return CMD_OK;
    }
    cmd_say("weartrack formats: there is no format '%s'; see weartrack formats list\n", id);
    return CMD_FAILED;
}

static int check_description(const char *xml, const char *sample, const wt_read_options *options,
                             const cmd_common *common)
{
    wt_error err = WT_ERROR_INIT;
    wt_input *input = NULL;
    wt_parselog *log = wt_parselog_new();
    wt_result *result = wt_result_new();
    wt_table *report = NULL;
    int status = CMD_OK;
    if (log == NULL || result == NULL) {
        wt_fail(&err, WT_E_MEMORY, "out of memory");
        goto fail;
    }
    if (sample != NULL && wt_input_open(sample, &input, &err) != WT_OK)
        goto fail;
    if (wt_description_check(xml, input, options, log, &report, &err) != WT_OK)
        goto fail;
    status = cmd_say_log("formats", common, log, true);
    if (wt_result_add(result, report, &err) != WT_OK || cmd_write(common, result, &err) != WT_OK)
        goto fail;
    goto done;
fail:
    cmd_say_log("formats", common, log, true);
    status = cmd_fail("formats", &err);
done:
    wt_result_free(result);
    wt_input_close(input);
    wt_parselog_free(log);
    return status;
}

int cmd_formats(int argc, char **argv)
{
    static const cmd_usage usage = {
        "formats", "list | show ID | check DESCRIPTION.xml [SAMPLE]",
        "list: the formats that are understood, and whether each was checked on a genuine file.\n"
        "show: the description of one of them; `show schema` prints the schema of descriptions.\n"
        "check: checks a description, and with a sample shows what is understood of it.",
        "output formats provenance", NULL};
    cmd_common common = cmd_common_defaults();
    wt_read_options read = wt_read_defaults();
    cmd_part part = {wt_read_params(), &read, "spring-constant sensitivity temperature units", 0};
    int first = 0, status = CMD_OK;
    wt_formats *formats = NULL;
    wt_parselog *log = NULL;
    wt_error err = WT_ERROR_INIT;
    if (!cmd_parse(&usage, &part, 1, &common, argc, argv, &first, &status))
        goto done;
    const char *verb = first < argc ? argv[first] : "";
    const int rest = argc - first - 1;
    if (strcmp(verb, "check") == 0 && (rest == 1 || rest == 2)) {
        status =
            check_description(argv[first + 1], rest == 2 ? argv[first + 2] : NULL, &read, &common);
        goto done;
    }
    const bool list = strcmp(verb, "list") == 0 && rest == 0;
    if (!list && !(strcmp(verb, "show") == 0 && rest == 1)) {
        status = cmd_usage_error("formats", "say list, show ID or check DESCRIPTION.xml [SAMPLE]");
        goto done;
    }
    log = wt_parselog_new();
    if (wt_formats_new(common.formats, &formats, log, &err) != WT_OK) {
        status = cmd_fail("formats", &err);
        goto done;
    }
    const int said = cmd_say_log("formats", &common, log, true);
    status = list ? list_formats(formats) : show_format(formats, argv[first + 1]);
    status = status == CMD_OK ? said : status;
done:
    wt_parselog_free(log);
    wt_formats_free(formats);
    cmd_parts_clear(&part, 1);
    return status;
}
