/* Every parameter has an effect: another value than the default changes the output of a subcommand
 * or a case. The tables here state values that no rule finds, and the reason for a parameter
 * without an effect on a result.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "call_text.h"
#include "params/sections.h"

#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#define CASE WT_FIXTURES "/case/"

enum { TEXT = 8192 };

/* ---- changed values -------------------------------------------------------------------------- */

static const struct {
    const char *name, *text;
    const char *with;    /* additional options, or elements of its section */
    const char *without; /* option that the base does not have */
} moved[] = {
    {"reference-temperature", "35degC", NULL, NULL},
    {"terms-per-decade", "2.7", NULL, NULL},
    {"sample-temperature-error", "2K", NULL, NULL},
    {"exclude", "temperature:..0degC", NULL, NULL},
    {"shift", "30degC=-0.6", NULL, NULL},
    {"shift-law", "wlf:reference-temperature=20degC,c1=9,c2=100K", NULL, NULL},
    {"prony-terms", "3", NULL, NULL},
    {"prony-error", "0.2", NULL, NULL},
    {"prony-long-term", "0Pa", NULL, NULL},
    {"expansion", "7e-4", "vertical-shift physical", NULL},
    {"fit-depth", "30nm", NULL, NULL},
    {"fit-retract", "yes", NULL, NULL},
    {"fit-depth-from", "20nm", NULL, NULL},
    {"fit-force", "10nN", NULL, NULL},
    {"fit-force-from", "5nN", NULL, NULL},
    {"fit-force-fraction-from", "0.2", NULL, NULL},
    {"fit-radii", "2", NULL, NULL},
    {"sample-thickness", "2um", NULL, NULL},
    {"unbonded", "yes", "sample-thickness 2um", NULL},
    {"fit-force-fraction", "0.5", NULL, NULL},
    {"misfit-p-threshold", "0.99", NULL, NULL},
    {"max-relative-error", "0.00001", NULL, NULL},
    {"warn-relative-error", "0.00001", "misfit-p-threshold 0.99", NULL},
    {"fixed-contact-point", "1um", NULL, NULL},
    {"baseline-from", "-5um", NULL, NULL},
    {"baseline-to", "-5um", NULL, NULL},
    {"tip", "sphere:radius=5um", NULL, NULL},
    {"kind", "sweep", NULL, NULL}, /* that file contains none */
    {"group", "track", NULL, NULL},
    {"curves", "worst:1", NULL, NULL},
    {"spot", "s1", NULL, NULL},
    {"spring-constant", "0.5N/m", NULL, NULL},
    {"sensitivity", "70nm/V", NULL, NULL},
    {"indentation-temperature", "40degC", NULL, NULL},
    {"track-temperature", "30degC", NULL, NULL},
    {"temperature-slope", "-0.02", "track-temperature 30degC", NULL},
    {"cantilevers", "two", NULL, "cantilevers"},
    {"spring-constant-error", "0.2", NULL, NULL},
    {"sensitivity-error", "0.1", NULL, NULL},
    {"piezo-nonlinearity", "0.001", NULL, NULL},
    {"detector-nonlinearity", "0.002", NULL, NULL},
    {"thick-sample", "yes", NULL, NULL},
    {"tip-error", "0.1", "cantilevers two", NULL},
    {"roughness", "self-affine:q0=2e3rad/m,q1=1e6rad/m,hurst=0.8,c0=2e-17m^4+-5%", NULL, NULL},
    {"pressure", "0.5MPa", NULL, NULL},
    {"velocity", "0.2m/s", NULL, NULL},
    {"sliding-temperature", "40degC", NULL, NULL},
    {"shear-stress", "6MPa", NULL, NULL},
    {"reference-velocity", "0.2m/s", NULL, NULL},
    {"replicates", "5", NULL, NULL},
    {"seed", "2", NULL, NULL},
    {"strain-softening", CASE "softening.txt", NULL, NULL},
    {"contact-size", "5mm", "flash-temperature yes", NULL},
    {"heat-capacity", "1e6J/(m^3 K)", "flash-temperature yes", NULL},
    {"heat-diffusivity", "2e-7m^2/s", "flash-temperature yes", NULL},
    {"layer-thickness", "2um", NULL, NULL},
    {"expected-thickness", "2um", NULL, NULL},
    {"modulus-ratio", "0.7", NULL, NULL},
    {"modulus-ratio-df", "3", NULL, NULL},
    {"critical-energy", "3e10J/m^3", NULL, NULL},
    {"observed-thickness", "3um", NULL, "critical-energy"},
    {"specific-wear-rate", "2e-12m^2/N", NULL, NULL},
    {"running-in-time", "600s", NULL, NULL},
    /* beyond the other limits of the product */
    {"prior-wear-from", "1e-12m^2/N", NULL, NULL},
    {"prior-energy-from", "2e11J/m^3", NULL, NULL},
    {"prior-wear-to", "2e-13m^2/N", NULL, NULL},
    {"prior-energy-to", "2e9J/m^3", NULL, NULL},
    {"times", "1:1e4s:log:7", NULL, NULL},
    {"layer-velocity", "0.2m/s", NULL, NULL},
    {"q0", "3e3rad/m", NULL, NULL},
    {"qr", "5e3rad/m", NULL, NULL},
    {"q1", "1e6rad/m", NULL, NULL},
    {"c0", "3e-17m^4", NULL, NULL},
    {"hurst", "0.7", NULL, NULL},
    {"error", "0.2", NULL, NULL},
    {"e0", "6MPa", NULL, NULL},
    {"eg", "3GPa", NULL, NULL},
    {"tau", "2us", NULL, NULL},
    {"alpha", "0.5", NULL, NULL},
    {"plane-poisson", "0.45", NULL, NULL},
    {"axial-poisson", "0.45", NULL, NULL},
    {"at", "25degC", NULL, NULL},
    {"tip-radius", "5um", NULL, NULL},
    {"end", "1e6rad/m", NULL, NULL},
    {"end-slope", "0.3", NULL, NULL},
    {"c1", "9", NULL, NULL},
    {"c2", "110K", NULL, NULL},
    {"load", "6N", NULL, NULL},
    {"track-radius", "13mm", NULL, NULL},
    {"track-area", "4e-11m^2", NULL, NULL},
    {"mass-loss", "4mg", NULL, NULL},
    {"density", "1200kg/m^3", NULL, NULL},
    {"track-length", "80mm", NULL, NULL},
    {"ball-radius", "4mm", NULL, NULL},
    {"modulus", "25MPa", NULL, NULL},
};

static const struct {
    const char *subcommand, *name, *because; /* NULL: any */
} dead[] = {
    {NULL, "threads", "changes no result: test_case_run"},
    {NULL, "quiet", "words on standard error: tests/cli"},
    {NULL, "log", "words on standard error: cli_log_json"},
    {NULL, "strict", "changes the exit status where there is a remark: tests/cli/remarks.txt"},
    {NULL, "files-from", "files as in the call: tests/cli/remarks.txt"},
    {NULL, "help", "tests/docs"},
    {NULL, "output", "where the result goes, not what it is"},
    {NULL, "formats", "further descriptions: tests/formats"},
    {NULL, "format", "overrules what is found: tests/cli"},
    {NULL, "columns", "for tables with other names: tests/cli/options.txt"},
    {NULL, "units", "for files without units: tests/formats"},
    {NULL, "pixel-size", "for images without a size: tests/formats"},
    {NULL, "height-unit", "for images without a unit: unit_read_images"},
    {NULL, "sheet", "for spreadsheets: unit_read_packed"},
    {NULL, "sample", "for sweeps of several samples: cli_samples"},
    {NULL, "spectrum-convention", "for spectra of other programs: cli_psd"},
    {NULL, "sample-by", "for sweeps of several samples: cli_samples"},
    {NULL, "conditioning", "for faulty data: cli_conditioning"},
    {NULL, "strain", "for isotherms of several amplitudes: tests/cli/payne.txt"},
    {NULL, "deformation", "for moduli whose names leave it open: tests/formats"},
    {NULL, "temperature", "for files without a temperature: tests/formats"},
    {NULL, "temperature-in-name", "for files without a temperature: tests/cli/samples.txt"},
    {NULL, "frequency", "for sweeps without a frequency: tests/cli/payne.txt"},
    {NULL, "material", "the base has the same from --dma: tests/cli/round_trip.txt"},
    {NULL, "dma", "the base has it"},
    {NULL, "master", "the base has it"},
    {"master", "shifts", "a file of shifts: tests/cli/shifts.txt"},
    {"master", "save-shifts", "where shifts go: tests/cli/shifts.txt"},
    {NULL, "contact", "a result with contact points: tests/cli/choices.txt"},
    {NULL, "overrides", "a file of choices: tests/cli/choices.txt"},
    {"record", "profile", "files of profiles: unit_record_job"},
    {"layer", "ratio-temperature", "of tables that are asked for: tests/cli/layer_models.txt"},
    {NULL, "ratio-by-rate", "of curves at several rates: tests/cli/layer_models.txt"},
    {NULL, "layer-comparison", "a file of weartrack compare: tests/cli/layer_models.txt"},
    {NULL, "wear-of", "a file of weartrack record: tests/cli/record.txt"},
    {NULL, "report", "where the report goes, not what it is"},
    {NULL, "no-report", "the base has it"},
    {NULL, "verbose", "reasons behind the short table: tests/cli/tribometers.txt"},
    {"case", "scan-lines", "for height maps with line faults: unit_job_conditioning, cli_psd"},
    {NULL, "style", "of the pictures: test_report"},
    {NULL, "figures", "of the pictures: unit_report_paper, tests/cli/bad_input.txt"},
    {NULL, "figure", "of the pictures: tests/cli/options.txt"},
    {NULL, "width", "of the pictures: unit_report_paper"},
    {NULL, "font", "the same"},
    {"compare", "between-spot-sd",
     "one spot of each: unit_case_tables_written, tests/cli/tables.txt"},
    {"case", "between-spot-sd", "the same"},
    {"master", "export", "a file of its own: unit_dma_finite_elements, tests/cli/solid.txt"},
    {"master", "export-units", "of that file"},
    {"master", "export-temperature", "of that file"},
    {"master", "export-domain", "of that file"},
    {"master", "export-name", "of that file"},
    {"master", "export-density", "of that file"},
    {"master", "export-expansion", "of that file"},
    {"master", "poisson-ratio", "of that file"},
    {NULL, "softening-temperature", "of several strain sweeps: tests/cli/softening.txt"},
    {NULL, "provenance", "tests/cli/round_trip.txt"},
};

/* Subcommand or "case". A parameter without an effect in any subcommand may have one in a case. */
static bool is_dead(const char *subcommand, const char *name)
{
    const bool of_case = strcmp(subcommand, "case") == 0;
    for (size_t i = 0; i < sizeof dead / sizeof dead[0]; i++)
        if (strcmp(dead[i].name, name) == 0 &&
            (dead[i].subcommand == NULL ? !of_case : strcmp(dead[i].subcommand, subcommand) == 0))
            return true;
    return false;
}

static bool is_listed(const char *name, char *text, size_t size, const char **with,
                      const char **without)
{
    for (size_t k = 0; k < sizeof moved / sizeof moved[0]; k++)
        if (strcmp(moved[k].name, name) == 0) {
            snprintf(text, size, "%s", moved[k].text);
            *with = moved[k].with != NULL ? moved[k].with : "";
            *without = moved[k].without != NULL ? moved[k].without : "";
            return true;
        }
    return false;
}

/* Text of a value other than the default. */
static bool move(const wt_params *params, size_t i, char *text, size_t size, const char **with,
                 const char **without)
{
    const wt_param *p = wt_params_get(params, i);
    char set[256], *end = set;
    *with = *without = "";
    if (is_listed(p->name, text, size, with, without))
        return true;
    wt_params_default(params, i, set, sizeof set);
    if (p->kind == PARAM_FLAG) {
        snprintf(text, size, "%s", strcmp(set, "yes") == 0 ? "no" : "yes");
        return true;
    }
    if (p->kind == PARAM_CHOICE) { /* the first word that is not the default */
        const size_t n = strlen(set);
        const bool first = strncmp(p->value, set, n) == 0 && p->value[n] == '|';
        const char *word = first ? p->value + n + 1 : p->value;
        snprintf(text, size, "%.*s", (int)strcspn(word, "|"), word);
        return true;
    }
    const double value = strtod(set, &end);
    if (p->kind != PARAM_NUMBER || end == set || value <= 0)
        return false;
    snprintf(text, size, "%g%s", 0.9 * value, end);
    return true;
}

/* ---- subcommands ----------------------------------------------------------------------------- */

static char folder[] = "/tmp/weartrack-alive-XXXXXX";

static const struct {
    const char *name;
    const char *base; /* NAME VALUE pairs, separated by '|'; a single name ends them */
    const char *files;
} subcommands[] = {
    {"indent", "tip pyramid:half-angle=20deg,radius=20nm|master master.tsv",
     CASE "bulk-1.jpk-force-map"},
    {"convert", "", CASE "bulk-1.jpk-force-map"},
    {"compare", "master master.tsv|spring-constant-error 0.1|cantilevers two",
     "bulk.tsv track.tsv"},
    {"master", "", CASE "dma.txt"},
    {"friction",
     "dma " CASE "dma.txt|roughness self-affine:q0=2e3rad/m,qr=4e3rad/m,q1=2e6rad/m,hurst=0.8,"
     "c0=2e-17m^4+-5%|pressure 0.4MPa|velocity 0.3m/s|shear-stress 5MPa+-10%|replicates 4|"
     "layer-thickness 1um|modulus-ratio 0.6+-0.05|sliding-temperature 30degC",
     ""},
    {"layer",
     "dma " CASE "dma.txt|roughness self-affine:q0=2e3rad/m,qr=4e3rad/m,q1=2e6rad/m,hurst=0.8,"
     "c0=2e-17m^4+-5%|pressure 0.4MPa|velocity 0.3m/s|replicates 4|"
     "specific-wear-rate 1e-12m^2/N|critical-energy 2e10J/m^3|sliding-temperature 30degC|"
     "shear-stress 5MPa+-10%|energy-from both",
     ""},
    {"record",
     "load 5N|track-radius 12mm|track-area 3e-11m^2+-20%|mass-loss 3mg+-0.2mg|density "
     "1150kg/m^3|ball-radius 3mm|modulus 20MPa",
     CASE "../record/disc.csv"},
    {"run", "replicates 4|no-report", "run.xml"},
};
enum { N_SUBCOMMANDS = sizeof subcommands / sizeof subcommands[0] };

/* Parameters of the options, by the names in --help. */
static const wt_params *(*const tables[])(void) = {
    wt_convert_job_params, wt_file_set_params,   wt_indent_job_params,
    wt_compare_job_params, wt_master_job_params, wt_layer_observation_params,
    wt_sliding_params,     wt_layer_job_params,  wt_job_params,
    wt_report_params,      wt_read_params,       wt_transverse_params,
    wt_reduction_params,   wt_record_job_params,
};

static char *read_file(const char *name, size_t *length)
{
    FILE *in = fopen(name, "rb");
    if (in == NULL)
        return NULL;
    char *bytes = NULL;
    FILE *copy = open_memstream(&bytes, length);
    for (int c; (c = getc(in)) != EOF;)
        putc(c, copy);
    fclose(in);
    fclose(copy);
    return bytes;
}

/* Output of a base, cached because most parameters use the base of the previous one. */
typedef struct kept {
    char *base, *bytes;
    size_t length;
} kept;

/* Clears the cache if it has another base. */
static bool is_of_base(kept *k, const char *base)
{
    if (k->base != NULL && strcmp(k->base, base) == 0)
        return true;
    free(k->base);
    free(k->bytes);
    k->base = strdup(base);
    assert_non_null(k->base);
    return false;
}

/* The output of a call: result, standard output, exit status. */
static char *run_call(const char *subcommand, const char *options, const char *files,
                      size_t *length)
{
    char command[TEXT];
    const char *out = strcmp(subcommand, "run") == 0 ? "out.h5" : "out.tsv";
    unlink(out);
    snprintf(command, sizeof command,
             "%s %s --no-provenance -o %s %s %s >stdout.txt 2>/dev/null; echo $? >>stdout.txt",
             WT_PROGRAM, subcommand, out, options, files);
    assert_int_equal(system(command), 0);
    size_t n[2] = {0, 0};
    char *parts[2] = {read_file(out, &n[0]), read_file("stdout.txt", &n[1])};
    char *all = malloc(n[0] + n[1] + 1);
    assert_non_null(all);
    for (size_t i = 0, used = 0; i < 2; used += n[i++])
        memcpy(all + used, parts[i] != NULL ? parts[i] : "", n[i]);
    free(parts[0]);
    free(parts[1]);
    *length = n[0] + n[1];
    return all;
}

/* The base as options, without one of them. */
static void base_options(const char *base, const char *without, char *options, size_t size)
{
    size_t used = 0;
    options[0] = '\0';
    for (const char *p = base; *p != '\0'; p += strspn(p, "|")) {
        const int length = (int)strcspn(p, "|"), name = (int)strcspn(p, " |");
        if (strlen(without) != (size_t)name || strncmp(p, without, (size_t)name) != 0)
            used += name < length
                        ? (size_t)snprintf(options + used, size - used, " --%.*s '%.*s'", name, p,
                                           length - name - 1, p + name + 1)
                        : (size_t)snprintf(options + used, size - used, " --%.*s", name, p);
        p += length;
    }
}

static bool is_flag(const char *name)
{
    for (size_t t = 0; t < sizeof tables / sizeof tables[0]; t++)
        for (size_t i = 0; i < wt_params_count(tables[t]()); i++) {
            const wt_param *p = wt_params_get(tables[t](), i);
            if (strcmp(p->name, name) == 0)
                return p->kind == PARAM_FLAG;
        }
    return false;
}

static size_t try_option(size_t s, const char *option, const char *text, const char *with,
                         const char *without)
{
    static kept before; /* The memory is reachable at exit, so it is no leak. */
    char base[TEXT], options[TEXT + 512], further[256], call[TEXT + 64];
    size_t n;
    base_options(with, "", further, sizeof further);
    char *const yes = strstr(further, " 'yes'"); /* A flag has no value here. */
    if (yes != NULL)
        *yes = '\0';
    base_options(subcommands[s].base, without, base, sizeof base);
    for (const char *p = with; *p != '\0'; p += strcspn(p, "|"), p += strspn(p, "|")) {
        char name[64];
        snprintf(name, sizeof name, "%.*s", (int)strcspn(p, " |"), p);
        drop_option(base, name);
    }
    strncat(base, further, sizeof base - strlen(base) - 1);
    snprintf(options, sizeof options, "%s", base);
    drop_option(options, option);
    snprintf(options + strlen(options), sizeof options - strlen(options), " --%s %s%s%s", option,
             text != NULL ? "'" : "", text != NULL ? text : "", text != NULL ? "'" : "");
    snprintf(call, sizeof call, "%s %s", subcommands[s].name, base);
    if (!is_of_base(&before, call))
        before.bytes = run_call(subcommands[s].name, base, subcommands[s].files, &before.length);
    char *after = run_call(subcommands[s].name, options, subcommands[s].files, &n);
    const bool wrong_call = n >= 2 && after[n - 2] == '2' && n < 4;
    const bool alive = !wrong_call && (n != before.length || memcmp(before.bytes, after, n) != 0);
    if (!alive)
        print_error("weartrack %s%s: --%s changes nothing\n", subcommands[s].name, options, option);
    free(after);
    return !alive;
}

/* Tests every option in the help of a subcommand. */
static void test_options(void **state)
{
    (void)state;
    size_t n_dead = 0, n_tried = 0;
    for (size_t s = 0; s < N_SUBCOMMANDS; s++) {
        char command[512], line[512];
        snprintf(command, sizeof command, "%s %s --help all", WT_PROGRAM, subcommands[s].name);
        FILE *help = popen(command, "r");
        assert_non_null(help);
        while (fgets(line, sizeof line, help) != NULL) {
            char option[64], text[256];
            if (strncmp(line + 6, "--", 2) != 0 || sscanf(line + 8, "%63[a-z-]", option) != 1)
                continue;
            const char *name = strncmp(option, "no-", 3) == 0 ? option + 3 : option;
            if (is_dead(subcommands[s].name, name) || is_dead(subcommands[s].name, option))
                continue;
            const char *with = "", *without = "", *value = NULL;
            bool found = is_listed(name, text, sizeof text, &with, &without);
            if (found && !is_flag(name))
                value = text;
            for (size_t t = 0; t < sizeof tables / sizeof tables[0] && !found; t++)
                for (size_t i = 0; i < wt_params_count(tables[t]()) && !found; i++) {
                    const wt_param *p = wt_params_get(tables[t](), i);
                    found = strcmp(p->name, name) == 0 &&
                            move(tables[t](), i, text, sizeof text, &with, &without);
                    if (found && p->kind != PARAM_FLAG)
                        value = text;
                }
            if (!found && line[8 + strlen(option)] == ' ' && line[9 + strlen(option)] != ' ')
                fail_msg("weartrack %s --%s: say here how to move it", subcommands[s].name, option);
            n_tried++;
            n_dead += try_option(s, option, value, with, without);
        }
        assert_int_equal(pclose(help), 0);
    }
    assert_int_equal(n_dead, 0);
    assert_true(n_tried > 60);
    /* A value without an effect is detected. */
    assert_int_equal(try_option(N_SUBCOMMANDS - 1, "threads", "2", "", ""), 1);
}

/* ---- cases ----------------------------------------------------------------------------------- */

static const struct {
    const char *section;
    const char *base; /* elements of the case */
    const char *before, *after;
} frames[] = {
    {"indentation",
     "<tip>pyramid:half-angle=20deg,radius=20nm</tip>"
     "<spring-constant-error>0.1</spring-constant-error>",
     "<indentation>",
     "<bulk><files>bulk-1.jpk-force-map</files><files>bulk-2.jpk-force-map</"
     "files></bulk>"
     "<track><files>track-1.jpk-force-map</"
     "files><files>track-2.jpk-force-map</files></track>"
     "</indentation><dma><files>dma.txt</files></dma>"},
    {"dma", "", "<dma>", "<files>dma.txt</files></dma>"},
    {"fractional-zener", "<e0>5MPa</e0><eg>2GPa</eg><tau>1us</tau><alpha>0.4</alpha>",
     "<dma><reference-temperature>30degC</reference-temperature><fractional-zener>",
     "</fractional-zener></dma>"},
    {"transverse", "<axial-poisson>0.4</axial-poisson>", "<dma><files>dma.txt</files><transverse>",
     "</transverse></dma>"},
    {"wlf", "<c1>8</c1><c2>100K</c2>",
     "<dma><reference-temperature>20degC</reference-temperature><prony deformation='tension'>"
     "<equilibrium>1MPa</equilibrium><term time='1e-3s' modulus='10MPa'/>"
     "<term time='1e-6s' modulus='100MPa'/></prony><wlf>",
     "</wlf></dma>"},
    {"self-affine", "<q0>2e3rad/m</q0><q1>2e6rad/m</q1><hurst>0.8</hurst><c0>2e-17m^4</c0>",
     "<roughness><self-affine>", "</self-affine></roughness>"},
    {"spectrum", "", "<roughness><spectrum><file>../formats/table-spectrum/surface.txt</file>",
     "</spectrum></roughness>"},
    {"measured", "", "<roughness>", "<files>../surface/place-1.gsf</files></roughness>"},
    {"sliding",
     "<pressure>0.4MPa</pressure><velocity>0.1m/s,0.3m/s,1m/s</velocity>"
     "<temperature>30degC</temperature><shear-stress>5MPa</shear-stress>",
     "<sliding>", "</sliding>"},
    {"layer",
     "<specific-wear-rate>1e-12m^2/N</specific-wear-rate>"
     "<critical-energy>2e10J/m^3</critical-energy><modulus-ratio>0.6+-0.05</modulus-ratio>",
     "<layer>", "</layer>"},
    {"identify",
     "<observed-thickness>3um+-15%</observed-thickness>"
     "<specific-wear-rate>1e-12m^2/N+-10%</specific-wear-rate>"
     "<running-in-time>500s+-10%</running-in-time>",
     "<identify>", "</identify>"},
    {"record",
     "<load>5N</load><track-radius>12mm</track-radius><track-area>3e-11m^2+-20%</track-area>"
     "<mass-loss>3mg+-0.2mg</mass-loss><density>1150kg/m^3</density>"
     "<ball-radius>3mm</ball-radius><modulus>20MPa</modulus>",
     "<record>", "<files>../record/disc.csv</files></record>"},
};
enum { N_FRAMES = sizeof frames / sizeof frames[0] };

/* Adds `elements` except those with the name `without`. */
static void add_elements(char *xml, size_t size, const char *elements, const char *without)
{
    for (const char *p = elements; *p == '<';) {
        char name[64], end[72];
        assert_int_equal(sscanf(p, "<%63[^>]>", name), 1);
        snprintf(end, sizeof end, "</%s>", name);
        const char *next = strstr(p, end) + strlen(end);
        if (strcmp(name, without) != 0)
            strncat(xml, p, (size_t)(next - p) < size - strlen(xml) ? (size_t)(next - p) : 0);
        p = next;
    }
}

/* Its frame contains a <dma>. */
static bool is_dma_part(const char *section)
{
    return strcmp(section, "wlf") == 0 || strcmp(section, "fractional-zener") == 0 ||
           strcmp(section, "transverse") == 0;
}

/* Returns a case in which section `s` has an effect, with the changed element. */
static void make_case(size_t s, const char *name, const char *text, const char *with,
                      const char *without, char *xml, size_t size)
{
    const char *section = case_sections[s].name;
    const bool indents = strcmp(section, "indentation") == 0;
    snprintf(xml, size, "<case version='1'>");
    for (size_t f = 0; f < N_FRAMES; f++) {
        const bool own = strcmp(frames[f].section, section) == 0;
        const bool other = (strcmp(frames[f].section, "dma") == 0 && !is_dma_part(section)) ||
                           (strcmp(frames[f].section, "self-affine") == 0 &&
                            strcmp(section, "spectrum") != 0 && strcmp(section, "measured") != 0) ||
                           strcmp(frames[f].section, "sliding") == 0 ||
                           strcmp(frames[f].section, "layer") == 0;
        if (!own && (indents || !other))
            continue;
        strncat(xml, frames[f].before, size - strlen(xml) - 1);
        char moved_element[512] = "";
        if (own && text != NULL)
            snprintf(moved_element, sizeof moved_element, "<%s>%s</%s>", name, text, name);
        /* The section has a fixed order and starts empty. */
        add_elements(xml, size, own ? with : "", "");
        add_elements(xml, size, moved_element, "");
        char rest[TEXT] = "";
        add_elements(rest, sizeof rest, frames[f].base, own && text != NULL ? name : "");
        add_elements(xml, size, rest, own ? without : "");
        strncat(xml, frames[f].after, size - strlen(xml) - 1);
    }
    /* tables that a case gives only on request */
    if (strcmp(name, "at") == 0)
        strncat(xml, "<report><result>moduli_at</result></report>", size - strlen(xml) - 1);
    if (strncmp(name, "prony-", 6) == 0)
        strncat(xml, "<report><result>prony_reduced</result></report>", size - strlen(xml) - 1);
    strncat(xml, "</case>", size - strlen(xml) - 1);
}

/* All tables of a run, except the notes about the run itself. */
static char *run_case(const char *xml, size_t *length)
{
    wt_case *c = NULL;
    wt_result *result = NULL;
    wt_error err = WT_ERROR_INIT;
    size_t n_failed = 0;
    wt_run_options options = wt_run_defaults();
    options.replicates = 2;
    options.no_provenance = true;
    char *bytes = NULL;
    FILE *out = open_memstream(&bytes, length);
    assert_non_null(out);
    if (case_from_bytes(xml, strlen(xml), CASE "alive.xml", &c, &err) != WT_OK ||
        wt_run_case(c, &options, NULL, &result, &n_failed, &err) != WT_OK)
        fail_msg("%s: %s: %s", xml, err.place, err.message);
    for (size_t i = 0; i < wt_result_n_tables(result); i++)
        if (strcmp(wt_table_name(wt_result_table(result, i)), "inputs") != 0)
            assert_int_equal(wt_stream_write(out, wt_result_table(result, i), NULL, &err), WT_OK);
    fclose(out);
    wt_result_free(result);
    wt_case_free(c);
    return bytes;
}

static void test_cases(void **state)
{
    (void)state;
    size_t n_dead = 0, n_tried = 0;
    kept base = {NULL, NULL, 0};
    for (size_t s = 0; s < N_CASE_SECTIONS; s++)
        for (size_t t = 0; t < SECTION_TABLES && case_sections[s].params[t] != NULL; t++) {
            const wt_params *params = case_sections[s].params[t]();
            for (size_t i = 0; i < wt_params_count(params); i++) {
                const wt_param *p = wt_params_get(params, i);
                const char *with = "", *without = "";
                char text[256], further[256] = "", xml[2][TEXT];
                if ((p->flags & PARAM_NO_CASE) != 0 || is_dead("case", p->name))
                    continue;
                if (!move(params, i, text, sizeof text, &with, &without))
                    fail_msg("<%s>: say here how to move it", p->name);
                const char *name = case_param_name(case_sections[s].name, p->name);
                char word[64], value[64];
                int read = 0;
                for (const char *w = with; sscanf(w, "%63s %63[^|]%n", word, value, &read) == 2;
                     w += read + (w[read] == '|'))
                    snprintf(further + strlen(further), sizeof further - strlen(further),
                             "<%s>%s</%s>", word, value, word);
                make_case(s, name, NULL, further, without, xml[0], sizeof xml[0]);
                make_case(s, name, text, further, without, xml[1], sizeof xml[1]);
                /* The base needs both options, and those of the changed one. */
                if (*without != '\0')
                    make_case(s, name, NULL, further, "", xml[0], sizeof xml[0]);
                size_t n;
                if (!is_of_base(&base, xml[0]))
                    base.bytes = run_case(xml[0], &base.length);
                char *after = run_case(xml[1], &n);
                if (n == base.length && memcmp(base.bytes, after, n) == 0) {
                    print_error("<%s> in <%s> changes nothing: %s\n", name, case_sections[s].name,
                                xml[1]);
                    n_dead++;
                }
                n_tried++;
                free(after);
            }
        }
    (void)is_of_base(&base, "");
    free(base.base);
    assert_int_equal(n_dead, 0);
    assert_true(n_tried > 35);
    /* A value without an effect is detected. */
    size_t n[2];
    char xml[2][TEXT + 32];
    make_case(1, "", NULL, "", "", xml[0], TEXT);
    snprintf(xml[1], sizeof xml[1], "<!-- the same -->%.*s", TEXT, xml[0]);
    char *before = run_case(xml[0], &n[0]), *after = run_case(xml[1], &n[1]);
    assert_true(n[0] == n[1] && memcmp(before, after, n[0]) == 0);
    free(before);
    free(after);
}

/* ---- inputs of the subcommands --------------------------------------------------------------- */

static int make_inputs(void **state)
{
    (void)state;
    char command[TEXT];
    if (mkdtemp(folder) == NULL || chdir(folder) != 0)
        return -1;
    snprintf(command, sizeof command,
             "W='%s -q'; W=%s; T=pyramid:half-angle=20deg,radius=20nm;"
             " $W indent -q --tip $T %sbulk-1* %sbulk-2* -o bulk.tsv &&"
             " $W indent -q --group track --tip $T %strack-1* %strack-2* -o "
             "track.tsv &&"
             " $W master -q %sdma.txt -o master.tsv",
             WT_PROGRAM, WT_PROGRAM, CASE, CASE, CASE, CASE, CASE);
    FILE *run = fopen("run.xml", "w");
    if (run == NULL)
        return -1;
    fprintf(run,
            "<case version='1'><dma><files>%sdma.txt</files></dma><roughness><self-affine>"
            "<q0>2e3rad/m</q0><q1>2e6rad/m</q1><hurst>0.8</hurst><c0>2e-17m^4 +- 5%%</c0>"
            "</self-affine></roughness><sliding><pressure>0.4MPa +- 5%%</pressure>"
            "<velocity>0.3m/s</velocity></sliding></case>",
            CASE);
    fclose(run);
    return system(command);
}

static int remove_inputs(void **state)
{
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return chdir("/") != 0 || system(command) != 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_options),
        cmocka_unit_test(test_cases),
    };
    return cmocka_run_group_tests_name("no parameter is ignored", tests, make_inputs,
                                       remove_inputs);
}
