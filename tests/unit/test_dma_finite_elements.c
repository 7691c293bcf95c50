/* Material files for finite elements. Each file is read by the rules of its program's manual and
 * loaded at once in tension by an independent time integration. The relaxation equals that of the
 * table, at the reference and, by the shift of the program, at other temperatures. */
#include "table_cells.h"

#include "weartrack/dma.h"

#include <ctype.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 200, FIELDS = 16 };

/* Values that a program knows, in its own units. */
typedef struct solid {
    size_t n, n_levels;
    double g[MOST], k[MOST], tau[MOST];
    double level[MOST], shear[MOST], bulk[MOST]; /* instantaneous; bulk infinite */
    bool shifts;
    double density, expansion; /* 0: missing */
    double t0, c1, c2, sign;   /* log10 of the time factor is sign C1 (T - T0)/(C2 + T - T0) */
} solid;

/* ---- the programs ---------------------------------------------------------------------------- */

static void of_young(double young, double nu, double *shear, double *bulk)
{
    *shear = young / (2 + 2 * nu);
    *bulk = young / (3 - 6 * nu);
}

/* Fields separated by commas, without surrounding blanks, in upper case. */
static size_t split(char *line, char *field[FIELDS])
{
    size_t n = 0;
    for (char *p = line; n < FIELDS; p++) {
        field[n] = p + strspn(p, " \t");
        p += strcspn(p, ",");
        const char end = *p;
        *p = '\0';
        for (char *c = field[n] + strlen(field[n]); c > field[n] && isspace((unsigned char)c[-1]);)
            *--c = '\0';
        for (char *c = field[n]; *c != '\0'; c++)
            *c = (char)toupper((unsigned char)*c);
        n++;
        if (end == '\0')
            return n;
    }
    fail_msg("too many fields");
    return n;
}

static double number(const char *text)
{
    char *end;
    const double x = strtod(text, &end);
    if (end == text || *end != '\0')
        fail_msg("\"%s\" is no number", text);
    return x;
}

/* Keyword lines begin with one star, comments with two; data lines follow their keyword. */
static void read_abaqus(char *text, solid *s)
{
    enum { NOTHING, ELASTIC, NEO, PRONY, TRS, DENSITY, EXPANSION } in = NOTHING;
    bool named = false, long_term = false;
    s->sign = 1;
    for (char *line = strtok(text, "\n"); line != NULL; line = strtok(NULL, "\n")) {
        char *field[FIELDS];
        if (strncmp(line, "**", 2) == 0)
            continue;
        assert_true(strlen(line) <= 256);
        const size_t n = split(line, field);
        if (field[0][0] == '*') {
            if (strcmp(field[0], "*MATERIAL") == 0) {
                named = n == 2 && strncmp(field[1], "NAME=", 5) == 0;
                in = NOTHING;
            } else if (strcmp(field[0], "*ELASTIC") == 0) {
                long_term = strcmp(field[1], "MODULI=LONG TERM") == 0;
                assert_true(long_term || strcmp(field[1], "MODULI=INSTANTANEOUS") == 0);
                in = ELASTIC;
            } else if (strcmp(field[0], "*HYPERELASTIC") == 0) {
                assert_int_equal(n, 3);
                assert_string_equal(field[1], "NEO HOOKE");
                long_term = strcmp(field[2], "MODULI=LONG TERM") == 0;
                assert_true(long_term || strcmp(field[2], "MODULI=INSTANTANEOUS") == 0);
                in = NEO;
            } else if (strcmp(field[0], "*VISCOELASTIC") == 0) {
                /* for vibrations the elasticity must be the long-term one */
                assert_string_equal(field[1], long_term ? "FREQUENCY=PRONY" : "TIME=PRONY");
                in = PRONY;
            } else if (strcmp(field[0], "*DENSITY") == 0) {
                in = DENSITY;
            } else if (strcmp(field[0], "*EXPANSION") == 0) {
                in = EXPANSION;
            } else if (strcmp(field[0], "*TRS") == 0) {
                assert_string_equal(field[1], "DEFINITION=WLF");
                in = TRS;
            } else {
                fail_msg("keyword %s", field[0]);
            }
            continue;
        }
        assert_true(named && n >= 2 && n <= 3);
        if (in == DENSITY || in == EXPANSION) {
            assert_true(n == 2 && field[1][0] == '\0');
            *(in == DENSITY ? &s->density : &s->expansion) = number(field[0]);
            continue;
        }
        const double a = number(field[0]), b = number(field[1]);
        if (in == ELASTIC || in == NEO) {
            s->level[s->n_levels] = n == 3 ? number(field[2]) : 0;
            if (in == ELASTIC) {
                assert_true(b < 0.5);
                of_young(a, b, &s->shear[s->n_levels], &s->bulk[s->n_levels]);
            } else {
                assert_true(b == 0); /* D1: incompressible */
                s->shear[s->n_levels] = 2 * a;
                s->bulk[s->n_levels] = (double)INFINITY;
            }
            s->n_levels++;
        } else if (in == PRONY) {
            assert_int_equal(n, 3);
            s->g[s->n] = a;
            s->k[s->n] = b;
            s->tau[s->n++] = number(field[2]);
        } else {
            assert_true(in == TRS && n == 3);
            /* log A = -C1 (T - T0)/(C2 + T - T0); reduced time is time over A */
            s->t0 = a;
            s->c1 = b;
            s->c2 = number(field[2]);
            s->shifts = true;
        }
    }
    double rest = 1; /* share of the instantaneous modulus */
    for (size_t i = 0; i < s->n; i++)
        rest -= s->g[i];
    for (size_t i = 0; long_term && i < s->n_levels; i++) {
        s->shear[i] /= rest;
        s->bulk[i] /= rest;
    }
}

/* '!' begins a comment. TB begins a table, TBDATA fills it from a position, TBTEMP begins its next
 * temperature. */
static void read_ansys(char *text, solid *s)
{
    enum { NOTHING, HYPER, SHEAR, BULK, SHIFT } in = NOTHING;
    double ratio = (double)NAN, constant[3] = {0, 0, 0};
    size_t last[2] = {0, 0};
    s->sign = 1;
    for (char *line = strtok(text, "\n"); line != NULL; line = strtok(NULL, "\n")) {
        char *field[FIELDS];
        line[strcspn(line, "!")] = '\0';
        assert_true(strlen(line) < 640);
        const size_t n = split(line, field);
        if (n == 1 && (field[0][0] == '\0' || strcmp(field[0], "MPTEMP") == 0))
            continue;
        if (n == 1 && strcmp(field[0], "RUBBER=1") == 0)
            continue;
        if (strcmp(field[0], "MP") == 0 && strcmp(field[1], "EX") == 0) {
            assert_string_equal(field[2], "RUBBER");
            /* Young's modulus, until the ratio is known */
            s->shear[s->n_levels++] = number(field[3]);
        } else if (strcmp(field[0], "MP") == 0) {
            assert_string_equal(field[1], "PRXY");
            ratio = number(field[3]);
        } else if (strcmp(field[0], "MPTEMP") == 0) {
            assert_true(n <= 8);
            for (size_t i = 2; i < n; i++)
                s->level[(size_t)number(field[1]) + i - 3] = number(field[i]);
        } else if (strcmp(field[0], "MPDATA") == 0) {
            assert_true(n <= 10 && strcmp(field[1], "EX") == 0);
            for (size_t i = 4; i < n; i++) {
                s->shear[(size_t)number(field[3]) + i - 5] = number(field[i]);
                s->n_levels++;
            }
        } else if (strcmp(field[0], "TB") == 0) {
            const char *option = n > 5 ? field[5] : "";
            assert_string_equal(field[2], "RUBBER");
            in = strcmp(field[1], "HYPER") == 0 && strcmp(option, "NEO") == 0     ? HYPER
                 : strcmp(field[1], "PRONY") == 0 && strcmp(option, "SHEAR") == 0 ? SHEAR
                 : strcmp(field[1], "PRONY") == 0 && strcmp(option, "BULK") == 0  ? BULK
                 : strcmp(field[1], "SHIFT") == 0 && strcmp(option, "WLF") == 0   ? SHIFT
                                                                                  : NOTHING;
            assert_true(in != NOTHING);
            if (in == SHEAR)
                s->n = (size_t)number(field[4]);
            assert_true(in != BULK || s->n == (size_t)number(field[4]));
        } else if (strcmp(field[0], "TBTEMP") == 0) {
            assert_true(in == HYPER);
            s->level[s->n_levels] = number(field[1]);
        } else {
            assert_string_equal(field[0], "TBDATA");
            assert_true(n <= 8); /* six constants */
            const size_t from = (size_t)number(field[1]);
            for (size_t i = 2; i < n; i++) {
                const size_t at = from + i - 3; /* from 0 */
                const double x = number(field[i]);
                if (in == SHEAR || in == BULK) {
                    if (at % 2 == 0)
                        (in == SHEAR ? s->g : s->k)[at / 2] = x;
                    else if (in == SHEAR)
                        s->tau[at / 2] = x;
                    else
                        assert_true(x == s->tau[at / 2]);
                    last[in - SHEAR] = at + 1;
                } else {
                    assert_true(at < 3);
                    constant[at] = x;
                }
            }
            if (in == HYPER) {
                assert_true(constant[1] == 0); /* d: incompressible */
                s->shear[s->n_levels] = constant[0];
                s->bulk[s->n_levels++] = (double)INFINITY;
            } else if (in == SHIFT) {
                /* log10 A = C1 (T - Tr)/(C2 + T - Tr); reduced time is A times time */
                s->t0 = constant[0];
                s->c1 = constant[1];
                s->c2 = constant[2];
                s->shifts = true;
            }
        }
    }
    assert_int_equal(last[0], 2 * s->n);
    assert_true(isnan(ratio) || last[1] == 2 * s->n);
    for (size_t i = 0; !isnan(ratio) && i < s->n_levels; i++)
        of_young(s->shear[i], ratio, &s->shear[i], &s->bulk[i]);
}

/* DEFI_MATERIAU states the numbers of a behaviour in the order of the @MaterialProperty
 * declarations in its source, which implements the Maxwell model. */
static void read_code_aster(char *text, solid *s)
{
    double value[8 * MOST], *of[16];
    char name[16][32];
    size_t n = 0, n_names = 0, used = 0, counts[16];
    char *list = strstr(text, "LISTE_COEF=(");
    assert_non_null(list);
    assert_non_null(
        strstr(text, "CREA_LIB_MFRONT(NOM_COMPOR=\"WeartrackMaxwell\", UNITE_MFRONT=38)"));
    assert_non_null(strstr(text, "@Behaviour WeartrackMaxwell;"));
    for (char *p = list + strlen("LISTE_COEF=("), *end; n < 8 * MOST;
         p = end + strspn(end, ", \n")) {
        value[n] = strtod(p, &end);
        if (end == p) {
            assert_true(p[strspn(p, " \n")] == ')');
            break;
        }
        n++;
    }
    for (char *p = text; (p = strstr(p, "@MaterialProperty ")) != NULL; p++) {
        int count = 1;
        assert_true(sscanf(p, "@MaterialProperty %*s %31[A-Za-z0-9][%d]", name[n_names], &count) >=
                    1);
        of[n_names] = value + used;
        counts[n_names++] = (size_t)count;
        used += (size_t)count;
    }
    assert_int_equal(used, n);
    static const char *const known[] = {"Nu", "El", "Ei", "Tau", "T0", "C1", "C2", "Tb", "Lb"};
    assert_int_equal(n_names, 9);
    for (size_t i = 0; i < 9; i++)
        assert_string_equal(name[i], known[i]);
    assert_int_equal(counts[2], counts[3]);
    assert_int_equal(counts[7], counts[8]);
    double young = *of[1];
    s->n = counts[2];
    for (size_t i = 0; i < s->n; i++)
        young += of[2][i];
    for (size_t i = 0; i < s->n; i++) {
        s->g[i] = s->k[i] = of[2][i] / young;
        s->tau[i] = of[3][i];
    }
    s->n_levels = counts[7];
    for (size_t i = 0; i < s->n_levels; i++) {
        s->level[i] = of[7][i];
        of_young(young * pow(10, of[8][i]), *of[0], &s->shear[i], &s->bulk[i]);
    }
    double elastic[2]; /* used by Code_Aster for its predictor */
    assert_int_equal(
        sscanf(strstr(text, "ELAS=_F("), "ELAS=_F(E=%lf, NU=%lf)", &elastic[0], &elastic[1]), 2);
    assert_near(elastic[0], young, 1e-10);
    assert_near(elastic[1], *of[0], 0);
    s->sign = 1;
    s->shifts = *of[5] != 0;
    s->t0 = *of[4];
    s->c1 = *of[5];
    s->c2 = *of[6];
}

static void read_table(char *text, solid *s)
{
    double young = (double)NAN, nu = (double)NAN, factor;
    bool rows = false;
    s->sign = 1;
    for (char *line = strtok(text, "\n"); line != NULL; line = strtok(NULL, "\n")) {
        if (rows) {
            double e, shear, bulk;
            assert_int_equal(sscanf(line, "%lf\t%lf\t%lf\t%lf\t%lf\t%lf", &s->tau[s->n],
                                    &s->g[s->n], &s->k[s->n], &e, &shear, &bulk),
                             6);
            assert_near(e, young * s->g[s->n], 1e-10);
            assert_near(shear, e / (2 + 2 * nu), 1e-10);
            if (nu < 0.5)
                assert_near(bulk, e / (3 - 6 * nu), 1e-10);
            else
                assert_true(isinf(bulk));
            s->n++;
        } else if (line[0] != '#') {
            assert_string_equal(
                line, "relaxation_time\tg\tk\tyoungs_modulus\tshear_modulus\tbulk_modulus");
            rows = true;
        }
        (void)sscanf(line, "# poisson_ratio %lf", &nu);
        (void)sscanf(line, "# instantaneous_modulus %lf", &young);
        (void)sscanf(line, "# reference_temperature %lf", &s->t0);
        s->shifts += sscanf(line, "# wlf_c1 %lf", &s->c1);
        (void)sscanf(line, "# wlf_c2 %lf", &s->c2);
        if (sscanf(line, "# factor of the moduli at %lf: %lf", &s->level[s->n_levels], &factor) ==
            2)
            of_young(young * factor, nu, &s->shear[s->n_levels], &s->bulk[s->n_levels]),
                s->n_levels++;
    }
    if (s->n_levels == 0) {
        of_young(young, nu, &s->shear[0], &s->bulk[0]);
        s->n_levels = 1;
    }
}

/* ---- programs of one temperature, with an elastic bulk modulus --------------------------------
 */

/* Content of a card with fixed columns: a sum of exponentials of the shear modulus. */
typedef struct shear_solid {
    size_t n;
    double modulus[MOST], rate[MOST], bulk, density; /* rate 0: long-term modulus */
} shear_solid;

static double column(const char *line, size_t from, size_t width)
{
    char text[32] = "";
    assert_true(strlen(line) >= from + width && width < sizeof text);
    memcpy(text, line + from, width);
    return number(text + strspn(text, " "));
}

static char *next_card(char **text, char comment)
{
    char *line;
    do
        line = strsep(text, "\n");
    while (line != NULL && line[0] == comment);
    return line;
}

static void read_ls_dyna(char *text, shear_solid *s)
{
    assert_string_equal(next_card(&text, '$'), "*MAT_GENERAL_VISCOELASTIC_TITLE");
    assert_string_equal(next_card(&text, '$'), "RUBBER");
    const char *line = next_card(&text, '$');
    assert_int_equal(strlen(line), 80);
    assert_near(column(line, 0, 10), 1, 0);
    s->density = column(line, 10, 10);
    s->bulk = column(line, 20, 10);
    for (size_t i = 3; i < 8; i++)
        assert_near_abs(column(line, 10 * i, 10), 0, 0); /* no shift law */
    line = next_card(&text, '$');
    for (size_t i = 0; i < 8; i++)
        assert_near_abs(column(line, 10 * i, 10), 0, 0); /* no relaxation curve */
    while ((line = next_card(&text, '$')) != NULL && *line != '\0') {
        assert_true(s->n < 18);
        s->modulus[s->n] = column(line, 0, 10);
        s->rate[s->n++] = column(line, 10, 10);
    }
}

static void read_openradioss(char *text, shear_solid *s)
{
    assert_string_equal(next_card(&text, '#'), "/MAT/LAW42/1");
    assert_string_equal(next_card(&text, '#'), "RUBBER");
    s->density = column(next_card(&text, '#'), 0, 20);
    const char *line = next_card(&text, '#');
    const double nu = column(line, 0, 20);
    const size_t n = (size_t)column(line, 80, 10);
    const double mu = column(next_card(&text, '#'), 0, 20);
    assert_string_equal(next_card(&text, '#'), "");
    const double alpha = column(next_card(&text, '#'), 0, 20);
    assert_string_equal(next_card(&text, '#'), "");
    s->modulus[0] = mu * alpha / 2;
    s->bulk = mu * alpha * (1 + nu) / (3 * (1 - 2 * nu));
    for (size_t i = 0; i < 2 * n; i++) {
        if (i % n % 5 == 0)
            line = next_card(&text, '#');
        const double value = column(line, i % n % 5 * 20, 20);
        if (i < n)
            s->modulus[i + 1] = value;
        else
            s->rate[i - n + 1] = 1 / value;
    }
    s->n = n + 1;
}

static void (*const readers[])(char *, solid *) = {[WT_FEM_ABAQUS] = read_abaqus,
                                                   [WT_FEM_ANSYS] = read_ansys,
                                                   [WT_FEM_CODE_ASTER] = read_code_aster,
                                                   [WT_FEM_TABLE] = read_table};

/* ---- step strain of a bar -------------------------------------------------------------------- */

static double at_level(const solid *s, const double *value, double t)
{
    size_t i = 1;
    if (s->n_levels == 1 || t <= s->level[0])
        return value[0];
    while (i < s->n_levels - 1 && s->level[i] < t)
        i++;
    if (t >= s->level[i])
        return value[i];
    return value[i - 1] +
           (value[i] - value[i - 1]) * (t - s->level[i - 1]) / (s->level[i] - s->level[i - 1]);
}

/* Stress over strain after `time` at the temperature t, by time steps with free sides. */
static double relaxed(const solid *s, double t, double time)
{
    enum { STEPS = 25 };
    const double shear = at_level(s, s->shear, t), bulk = at_level(s, s->bulk, t);
    const double speed =
        s->shifts ? pow(10, s->sign * s->c1 * (t - s->t0) / (s->c2 + t - s->t0)) : 1;
    double q[MOST] = {0}, v[MOST] = {0}, rest_g = 1, rest_k = 1, e = 0, volume = 0, at = 0;
    double stress = (double)NAN;
    for (size_t i = 0; i < s->n; i++) {
        rest_g -= s->g[i];
        rest_k -= s->k[i];
    }
    for (int step = 0; step <= STEPS; step++) {
        /* the jump, then growing steps */
        const double next =
            step == 0 ? 0 : time * speed * pow(10, -12.0 * (1 - step / (double)STEPS));
        const double h = next - at;
        double old_d = 0, old_p = 0, by_d = rest_g, by_p = rest_k;
        for (size_t i = 0; i < s->n; i++) {
            const double x = h / s->tau[i], w = x > 1e-9 ? -expm1(-x) / x : 1;
            q[i] *= exp(-x);
            v[i] *= exp(-x);
            old_d += s->g[i] * q[i];
            old_p += s->k[i] * v[i];
            by_d += s->g[i] * w;
            by_p += s->k[i] * w;
        }
        old_d += rest_g * e;
        old_p += rest_k * volume;
        /* strain 1 along, y across: deviator 2/3 (1 - y), volume 1 + 2 y; no stress across */
        double y = -0.5;
        if (isfinite(bulk)) {
            const double d0 = 2 * shear * (old_d + by_d * (2.0 / 3 - e)),
                         d1 = -2 * shear * by_d * 2.0 / 3,
                         p0 = bulk * (old_p + by_p * (1 - volume)), p1 = 2 * bulk * by_p;
            y = (d0 / 2 - p0) / (p1 - d1 / 2);
        }
        const double new_e = 2.0 / 3 * (1 - y), new_volume = 1 + 2 * y;
        const double d = 2 * shear * (old_d + by_d * (new_e - e));
        for (size_t i = 0; i < s->n; i++) {
            const double x = h / s->tau[i], w = x > 1e-9 ? -expm1(-x) / x : 1;
            q[i] += w * (new_e - e);
            v[i] += w * (new_volume - volume);
        }
        e = new_e;
        volume = new_volume;
        at = next;
        stress = 1.5 * d; /* and the pressure that keeps the sides free */
    }
    return stress;
}

/* ---- origin of the file ---------------------------------------------------------------------- */

static wt_master_tables tables;

static int make(void **state)
{
    (void)state;
    static const char *const files[] = {WT_SOURCE_DIR "/fixtures/case/dma.txt"};
    const wt_file_set set = {.patterns = files, .n_patterns = 1, .read = wt_read_defaults()};
    wt_master_job job = wt_master_job_defaults();
    wt_job work = wt_job_defaults();
    wt_formats *formats = NULL;
    assert_int_equal(wt_formats_new(NULL, &formats, NULL, NULL), WT_OK);
    work.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    assert_int_equal(wt_master_compute(&job, &work, &tables, NULL, NULL), WT_OK);
    wt_formats_free(formats);
    return 0;
}

static int clear(void **state)
{
    (void)state;
    wt_master_tables_clear(&tables);
    return 0;
}

static double key(const wt_table *table, const char *name)
{
    wt_estimate e;
    assert_true(wt_table_estimate(table, name, &e));
    return e.value;
}

/* E(t) of the library at an isotherm, or at the reference (a row without an isotherm). */
static double known(const wt_shift_law *law, size_t row, double to_young, double time)
{
    const wt_table *p = tables.prony_reduced, *shifts = tables.shift_factors;
    const bool reference = row >= wt_table_n_rows(shifts);
    const double log_a =
        reference ? 0 : wt_shift_law_log_a(law, number_cell(shifts, row, "temperature"));
    const double b = reference ? 1 : pow(10, number_cell(shifts, row, "log_b_material"));
    double sum = key(p, "equilibrium_modulus");
    for (size_t i = 0; i < wt_table_n_rows(p); i++)
        sum += number_cell(p, i, "modulus") *
               exp(-time / (number_cell(p, i, "relaxation_time") * pow(10, log_a)));
    return to_young * sum / b;
}

static void write(wt_fem_program program, const wt_fem_export_options *o, char **text)
{
    size_t n;
    wt_error err = WT_ERROR_INIT;
    FILE *out = open_memstream(text, &n);
    if (wt_fem_export(out, program, tables.prony_reduced, tables.shift_factors, o, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    assert_int_equal(fclose(out), 0);
}

/* Every isotherm, and times from the fastest to the slowest measured ones. */
static void check(wt_fem_program program, const wt_fem_export_options *o, const wt_shift_law *law)
{
    static const double stress[] = {1, 1e6, 1e9}, second[] = {1, 1, 1e3};
    const double zero = o->temperature == WT_FEM_CELSIUS ? WT_ZERO_CELSIUS : 0;
    const wt_table *p = tables.prony_reduced;
    const bool shear = strcmp(wt_table_key(p, "deformation"), "shear") == 0;
    const double to_young = shear ? 2 * (1 + o->poisson_ratio) : 1;
    const size_t isotherms = wt_table_n_rows(tables.shift_factors);
    solid s = {0};
    char *text = NULL;
    write(program, o, &text);
    readers[program](text, &s);
    free(text);
    assert_int_equal(s.n, wt_table_n_rows(p));
    assert_int_equal(s.shifts, law->kind != WT_LAW_NONE && o->domain == WT_FEM_TIME);
    size_t tried = 0;
    for (size_t row = 0; row <= isotherms; row++) {
        if (!s.shifts && row < isotherms)
            continue;
        const double t = row < isotherms ? number_cell(tables.shift_factors, row, "temperature")
                                         : key(p, "reference_temperature");
        const double a = row < isotherms ? pow(10, wt_shift_law_log_a(law, t)) : 1;
        for (int i = -2; i <= 12; i++) {
            const double time = a / key(p, "frequency_max") *
                                pow(key(p, "frequency_max") / key(p, "frequency_min"), i / 10.0);
            const double is = relaxed(&s, t - zero, time * second[o->units]) * stress[o->units];
            assert_near(is, known(law, row, to_young, time), 1e-6);
            tried++;
        }
    }
    assert_true(tried >= 15);
}

static wt_shift_law fitted_law(void)
{
    assert_string_equal(wt_table_key(tables.shift_factors, "law"), "WLF");
    return (wt_shift_law){.kind = WT_LAW_WLF,
                          .wlf = {key(tables.prony_reduced, "reference_temperature"),
                                  key(tables.shift_factors, "wlf_c1"),
                                  key(tables.shift_factors, "wlf_c2")}};
}

static void check_all(const wt_shift_law *law)
{
    for (int program = WT_FEM_ABAQUS; program <= WT_FEM_TABLE; program++)
        for (int units = 0; units < 3; units++)
            for (int kelvin = 0; kelvin < 2; kelvin++)
                for (int i = 0; i < 2; i++) {
                    wt_fem_export_options o = wt_fem_export_options_defaults();
                    o.units = (wt_fem_units)units;
                    o.temperature = (wt_fem_temperature)kelvin;
                    o.poisson_ratio = i == 0 ? 0.45 : 0.5;
                    if (readers[program] != NULL && (program != WT_FEM_CODE_ASTER || i == 0))
                        check((wt_fem_program)program, &o, law);
                }
}

/* ---- tests ----------------------------------------------------------------------------------- */

static void relaxation_is_that_of_the_fit(void **state)
{
    (void)state;
    const wt_shift_law law = fitted_law();
    check_all(&law);
}

static void shear_relaxation(void **state)
{
    (void)state;
    const wt_shift_law law = fitted_law();
    assert_int_equal(wt_table_set_key(tables.prony_reduced, "deformation", "shear", NULL), WT_OK);
    check_all(&law);
    assert_int_equal(wt_table_set_key(tables.prony_reduced, "deformation", "tension", NULL), WT_OK);
}

static void holds_text(const char *text, const char *words)
{
    if (strstr(text, words) == NULL)
        fail_msg("no \"%s\" in:\n%s", words, text);
}

/* Shear relaxation of explicit programs at the reference temperature. */
static void at_one_temperature(void **state)
{
    (void)state;
    static const double stress[] = {1, 1e6, 1e9}, second[] = {1, 1, 1e3},
                        density[] = {1, 1e-12, 1e-9};
    static const wt_fem_program programs[] = {WT_FEM_LS_DYNA, WT_FEM_OPENRADIOSS};
    static void (*const read[])(char *, shear_solid *) = {read_ls_dyna, read_openradioss};
    static const double digits[] = {2e-4, 1e-10};
    const wt_table *p = tables.prony_reduced;
    const double nu = 0.49;
    const bool shear = strcmp(wt_table_key(p, "deformation"), "shear") == 0;
    const double to_shear = shear ? 1 : 1 / (2 * (1 + nu));
    for (size_t i = 0; i < 2; i++)
        for (int units = 0; units < 3; units++) {
            wt_fem_export_options o = wt_fem_export_options_defaults();
            shear_solid s = {0};
            char *text = NULL;
            o.units = (wt_fem_units)units;
            o.poisson_ratio = nu;
            o.density = 1120;
            write(programs[i], &o, &text);
            holds_text(text, "hold at the reference temperature alone");
            read[i](text, &s);
            free(text);
            assert_int_equal(s.n, wt_table_n_rows(p) + 1);
            assert_near(s.density, 1120 * density[units], digits[i]);
            assert_near(s.bulk * stress[units],
                        2 * (1 + nu) * to_shear * key(p, "equilibrium_modulus") /
                            (3 * (1 - 2 * nu)),
                        digits[i]);
            for (int k = -2; k <= 12; k++) {
                const double time =
                    pow(key(p, "frequency_max") / key(p, "frequency_min"), k / 10.0) /
                    key(p, "frequency_max");
                double sum = 0;
                for (size_t m = 0; m < s.n; m++)
                    sum += s.modulus[m] * exp(-time * second[units] * s.rate[m]);
                assert_near(sum * stress[units], known(NULL, SIZE_MAX, to_shear, time), digits[i]);
            }
        }
}

/* Abaqus for vibrations: the same series with the long-term modulus, and no shifts. */
static void vibration_series(void **state)
{
    (void)state;
    const wt_shift_law law = fitted_law();
    for (int i = 0; i < 2; i++) {
        wt_fem_export_options o = wt_fem_export_options_defaults();
        o.domain = WT_FEM_FREQUENCY;
        o.poisson_ratio = i == 0 ? 0.45 : 0.5;
        check(WT_FEM_ABAQUS, &o, &law);
    }
}

/* 1120 kg/m3 are 1.12e-9 t/mm3 and 1.12e-6 kg/mm3. */
static void density_and_expansion(void **state)
{
    (void)state;
    static const double factor[] = {1, 1e-12, 1e-9};
    wt_fem_export_options o = wt_fem_export_options_defaults();
    char *text = NULL;
    o.density = 1120;
    o.expansion = 2.1e-4;
    o.name = "TREAD_7";
    o.poisson_ratio = 0.45;
    for (int units = 0; units < 3; units++) {
        solid s = {0};
        o.units = (wt_fem_units)units;
        write(WT_FEM_ABAQUS, &o, &text);
        holds_text(text, "*MATERIAL, NAME=TREAD_7\n");
        read_abaqus(text, &s);
        assert_near(s.density, 1120 * factor[units], 1e-10);
        assert_near(s.expansion, 2.1e-4, 1e-10);
        free(text);
    }
    o.units = WT_FEM_MM_T_S;
    write(WT_FEM_ANSYS, &o, &text);
    holds_text(text, "\nTREAD_7=1 ");
    holds_text(text, "\nMP,DENS,TREAD_7,1.12e-09\nMP,ALPX,TREAD_7,0.00021\n");
    holds_text(text, "\nMPDATA,EX,TREAD_7,1,");
    holds_text(text, "\nTB,PRONY,TREAD_7,1,");
    holds_text(text, "\nTB,SHIFT,TREAD_7,1,3,WLF\n");
    assert_null(strstr(text, "RUBBER"));
    free(text);
    write(WT_FEM_CODE_ASTER, &o, &text);
    holds_text(text, "\nTREAD_7 = DEFI_MATERIAU(\n    ELAS=_F(E=");
    holds_text(text, ", RHO=1.12e-09, ALPHA=0.00021),\n");
    free(text);
    write(WT_FEM_TABLE, &o, &text);
    holds_text(text, "# density 1.12e-09\n# thermal_expansion 0.00021\n");
    free(text);
}

/* The storage modulus at the limit of the measurement, and the share of the instantaneous modulus
 * beyond it. */
static void instantaneous_modulus_is_stated(void **state)
{
    (void)state;
    const wt_table *p = tables.prony_reduced;
    const wt_fem_export_options o = wt_fem_export_options_defaults();
    double at_end = key(p, "equilibrium_modulus"), all = at_end, told = 0, beyond = 0;
    for (size_t i = 0; i < wt_table_n_rows(p); i++) {
        const double x = key(p, "frequency_max") * number_cell(p, i, "relaxation_time");
        at_end += number_cell(p, i, "modulus") * x * x / (1 + x * x);
        all += number_cell(p, i, "modulus");
    }
    char *text = NULL;
    write(WT_FEM_ABAQUS, &o, &text);
    const char *words = strstr(text, "highest frequency measured the storage modulus is ");
    assert_non_null(words);
    assert_int_equal(
        sscanf(words, "highest frequency measured the storage modulus is %lf,\n** and %lf %% of",
               &told, &beyond),
        2);
    assert_near(told, at_end, 1e-5);
    assert_near(beyond, 100 * (1 - at_end / all), 0.06);
    free(text);
}

static void in_another_locale(void **state)
{
    (void)state;
    const wt_shift_law law = fitted_law();
    const wt_fem_export_options o = wt_fem_export_options_defaults();
    char *text = NULL, *same = NULL;
    write(WT_FEM_ABAQUS, &o, &text);
    if (setlocale(LC_NUMERIC, "de_DE.UTF-8") == NULL)
        (void)setlocale(LC_NUMERIC, "fr_FR.UTF-8");
    write(WT_FEM_ABAQUS, &o, &same);
    (void)setlocale(LC_NUMERIC, "C");
    assert_string_equal(text, same);
    free(text);
    free(same);
    (void)law;
}

/* Arrhenius through the same cards; without a law no card. */
static void other_laws(void **state)
{
    (void)state;
    const wt_shift_law arrhenius = {
        .kind = WT_LAW_ARRHENIUS,
        .wlf = {.reference_temperature = key(tables.prony_reduced, "reference_temperature")},
        .activation_energy = 120e3};
    const wt_estimate energy = {120e3, 0, 0, "J/mol"};
    wt_table *shifts = tables.shift_factors;
    assert_int_equal(wt_table_set_key(shifts, "law", "Arrhenius", NULL), WT_OK);
    assert_int_equal(wt_table_set_estimate(shifts, "activation_energy", energy, NULL), WT_OK);
    check_all(&arrhenius);
    assert_int_equal(wt_table_set_key(shifts, "law", "none: flat", NULL), WT_OK);
    check_all(&(wt_shift_law){.kind = WT_LAW_NONE});
    assert_int_equal(wt_table_set_key(shifts, "law", "WLF", NULL), WT_OK);
}

/* For a law of two parts the card has the part at the reference, and the file describes the
 * other. */
static void check_joined(double from_reference, bool below)
{
    wt_table *shifts = tables.shift_factors;
    const double reference = key(tables.prony_reduced, "reference_temperature");
    const wt_estimate joint = {reference + from_reference, 0, 0, "K"};
    const wt_shift_law law = {.kind = WT_LAW_WLF_ARRHENIUS,
                              .wlf = {reference, key(shifts, "wlf_c1"), key(shifts, "wlf_c2")},
                              .activation_energy = 120e3,
                              .joint = joint.value};
    wt_fem_export_options o = wt_fem_export_options_defaults();
    char *text = NULL, side[8];
    solid s = {0};
    double at, offset, c1, c2;
    o.temperature = WT_FEM_KELVIN;
    assert_int_equal(wt_table_set_estimate(shifts, "joint", joint, NULL), WT_OK);
    write(WT_FEM_ABAQUS, &o, &text);
    const char *words = strstr(text, "** Only ");
    assert_non_null(words);
    assert_int_equal(
        sscanf(words,
               "** Only %7s Tj = %lf. On the other side it is log10 aT = %lf - C1 (T - "
               "Tj)/(C2 + T - Tj) ** with C1 = %lf and C2 = %lf",
               side, &at, &offset, &c1, &c2),
        5);
    assert_string_equal(side, below ? "below" : "above");
    assert_near(at, joint.value, 1e-5);
    for (int i = 0; i < 3; i++) {
        const double away = (below ? 1 : -1) * 15.0 * i;
        assert_near_abs(offset - c1 * away / (c2 + away),
                        wt_shift_law_log_a(&law, joint.value + away), 1e-9);
    }
    read_abaqus(text, &s);
    assert_near(s.c1, below ? 120e3 / (8.31446261815324 * log(10) * reference) : law.wlf.c1, 1e-10);
    assert_near(s.c2, below ? reference : law.wlf.c2, 1e-10);
    free(text);
}

static void law_of_two_parts(void **state)
{
    (void)state;
    wt_table *shifts = tables.shift_factors;
    assert_int_equal(wt_table_set_key(shifts, "law", "joined", NULL), WT_OK);
    check_joined(-12.5, false);
    check_joined(12.5, true);
    assert_int_equal(wt_table_set_key(shifts, "law", "WLF", NULL), WT_OK);
}

static void refused(void **state)
{
    (void)state;
    wt_fem_export_options o = wt_fem_export_options_defaults();
    wt_fem_program program;
    wt_error err = WT_ERROR_INIT;
    FILE *out = fopen("/dev/null", "w");
    assert_int_equal(
        wt_fem_export(out, WT_FEM_CODE_ASTER, tables.prony_reduced, tables.shift_factors, &o, &err),
        WT_E_RANGE);
    assert_string_equal(err.place, "poisson-ratio");
    static const char *const names[] = {"",    "7a",  "a b",
                                        "a-b", "a,b", "a23456789012345678901234567890123"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        o.name = names[i];
        assert_int_equal(wt_fem_export_check(WT_FEM_ANSYS, &o, &err), WT_E_ARG);
        assert_string_equal(err.place, "export-name");
    }
    o.name = "NR_CB_50x";
    assert_int_equal(wt_fem_export_check(WT_FEM_ANSYS, &o, NULL), WT_OK);
    o.poisson_ratio = 0.49;
    assert_int_equal(wt_fem_export_check(WT_FEM_CODE_ASTER, &o, NULL), WT_E_ARG);
    o.name = "NR_CB_50";
    assert_int_equal(wt_fem_export_check(WT_FEM_CODE_ASTER, &o, NULL), WT_OK);
    for (int i = WT_FEM_LS_DYNA; i <= WT_FEM_OPENRADIOSS; i++) {
        o.poisson_ratio = 0.49;
        assert_int_equal(wt_fem_export_check((wt_fem_program)i, &o, &err), WT_E_RANGE);
        assert_string_equal(err.place, "export-density");
        o.density = 1100;
        assert_int_equal(wt_fem_export_check((wt_fem_program)i, &o, NULL), WT_OK);
        o.poisson_ratio = 0.5;
        assert_int_equal(wt_fem_export_check((wt_fem_program)i, &o, NULL), WT_E_RANGE);
        o.density = (double)NAN;
    }
    o.poisson_ratio = 0.6;
    assert_int_equal(wt_fem_export(out, WT_FEM_ABAQUS, tables.prony_reduced, NULL, &o, NULL),
                     WT_E_RANGE);
    assert_int_equal(wt_fem_export(out, WT_FEM_ABAQUS, NULL, NULL, NULL, NULL), WT_E_MISSING);
    assert_int_equal(wt_fem_export(NULL, WT_FEM_ABAQUS, tables.prony_reduced, NULL, NULL, NULL),
                     WT_E_ARG);
    fclose(out);
    out = fopen("/dev/full", "w");
    assert_int_equal(setvbuf(out, NULL, _IONBF, 0), 0);
    assert_int_equal(
        wt_fem_export(out, WT_FEM_ABAQUS, tables.prony_reduced, tables.shift_factors, NULL, NULL),
        WT_E_IO);
    fclose(out);
    assert_true(wt_fem_program_find("ansys:x", 5, &program));
    assert_int_equal(program, WT_FEM_ANSYS);
    assert_false(wt_fem_program_find("ansys", 4, &program));
    assert_false(wt_fem_program_find("nastran", 7, &program));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(relaxation_is_that_of_the_fit),
        cmocka_unit_test(shear_relaxation),
        cmocka_unit_test(at_one_temperature),
        cmocka_unit_test(vibration_series),
        cmocka_unit_test(density_and_expansion),
        cmocka_unit_test(instantaneous_modulus_is_stated),
        cmocka_unit_test(in_another_locale),
        cmocka_unit_test(other_laws),
        cmocka_unit_test(law_of_two_parts),
        cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests(tests, make, clear);
}
