/* Writes the inputs of conditioning.txt into a folder: sound data, and the same data with one fault
 * each. The true values of the rubber, friction records and surfaces are known.
 *
 * Usage: conditioning_files FOLDER
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *folder;
static uint64_t state = 1;

static double uniform(void)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) / 9007199254740992.0;
}

static double normal(void)
{
    double sum = -6;
    for (int i = 0; i < 12; i++)
        sum += uniform();
    return sum;
}

static FILE *begin(const char *name, uint64_t seed)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *const out = fopen(path, "wb");
    if (out == NULL) {
        perror(path);
        exit(1);
    }
    state = 1000003 * (seed + 1);
    return out;
}

/* ---- rubber ---------------------------------------------------------------------------------- */

enum { ISOTHERMS = 7, FREQUENCIES = 10 };
#define REFERENCE 25.0

typedef struct point {
    double celsius, hertz, storage, loss; /* loss and storage modulus [MPa] */
} point;

static double log_a(double celsius)
{
    return -8.2 * (celsius - REFERENCE) / (110 + celsius - REFERENCE);
}

static point measure(double celsius, double hertz, double noise)
{
    const double omega = 2 * M_PI * hertz * pow(10, log_a(celsius));
    double storage = 1, loss = 0;
    for (int i = -48; i <= 20; i++) {
        const double x = i / 4.0, wt = omega * pow(10, x);
        const double peak = (x + 6) / 1.8, tail = (x + 1) / 3;
        const double g = 90 * exp(-peak * peak / 2) + 0.2 * exp(-tail * tail / 2);
        storage += g * wt * wt / (1 + wt * wt);
        loss += g * wt / (1 + wt * wt);
    }
    const double scale = (celsius + 273.15) / (REFERENCE + 273.15);
    return (point){celsius, hertz, storage * scale * exp(noise * normal()),
                   loss * scale * exp(noise * normal())};
}

typedef enum fault {
    SOUND,
    DRIFT,
    FLAGGED,
    ANGULAR_SAME,
    TAN_DOUBLED,
    REDUNDANT,
    SPECIMENS,
    OVEN,
    TWICE,
    MILLI,
    RADIANS,
    KELVIN,
    NEGATIVE_LOSS,
    STIFFER,
    LINES_ABOVE
} fault;

static const char *const sweep_names[] = {
    [ANGULAR_SAME] = "f (Hz),omega (rad/s),E' (MPa),E'' (MPa),T (degC)",
    [TAN_DOUBLED] = "f (Hz),E' (MPa),E'' (MPa),tan delta,T (degC)",
    [REDUNDANT] = "f (Hz),omega (rad/s),E' (MPa),E'' (MPa),tan delta,T (degC),T (K)",
    [SPECIMENS] = "Specimen,f (Hz),E' (MPa),E'' (MPa),T (degC)",
    [OVEN] = "f (Hz),E' (MPa),E'' (MPa),T (degC),Sample temperature (degC)",
    [MILLI] = "f (Hz),E' (mPa),E'' (mPa),T (degC)",
    [LINES_ABOVE] = "f (Hz),E' (MPa),E'' (MPa)"};

static const char rheo_head[] =
    "Interval and data points:\t%d\t%d\nInterval data:\tPoint No.\tAngular Frequency\tStorage "
    "Modulus\tLoss Modulus\tStatus\tTemperature\n\t\t[rad/s]\t[Pa]\t[Pa]\t\t[\u00b0C]\n";

static void put_row(FILE *out, fault kind, int isotherm, int k, point p)
{
    const bool is_one = isotherm == 3; /* index of the faulty isotherm */
    const bool flagged = kind == FLAGGED && k >= FREQUENCIES - 3;
    if (kind == FLAGGED) {
        fprintf(out, "\t%d\t%g\t%g\t%g\t%s\t%g\n", k + 1, 2 * M_PI * p.hertz,
                (flagged ? 0.3 : 1) * 1e6 * p.storage, (flagged ? 1e-3 : 1) * 1e6 * p.loss,
                flagged ? "ME-,TruStrain\u2122" : "TruStrain\u2122", p.celsius);
        return;
    }
    if (kind == SPECIMENS)
        fprintf(out, "S%d,", k % 2 + 1);
    fprintf(out, "%.6g", kind == RADIANS && is_one ? 2 * M_PI * p.hertz : p.hertz);
    if (kind == ANGULAR_SAME || kind == REDUNDANT)
        fprintf(out, ",%.6g", (kind == REDUNDANT ? 2 * M_PI : 1) * p.hertz);
    const double stiffer = kind == SPECIMENS && k % 2 == 1 ? 1.3 : 1;
    const double sign = is_one && kind == NEGATIVE_LOSS ? -1 : 1;
    fprintf(out, ",%.6g,%.6g", stiffer * p.storage, stiffer * sign * p.loss);
    if (kind == TAN_DOUBLED || kind == REDUNDANT)
        fprintf(out, ",%.6g", (kind == REDUNDANT ? 1 : 2) * p.loss / p.storage);
    if (kind != LINES_ABOVE)
        fprintf(out, ",%.6g",
                p.celsius + (kind == OVEN               ? 4
                             : kind == KELVIN && is_one ? 273.15
                                                        : 0));
    if (kind == REDUNDANT)
        fprintf(out, ",%.6g", p.celsius + 273.15);
    if (kind == OVEN)
        fprintf(out, ",%.6g", p.celsius);
    fputc('\n', out);
}

static void write_sweep(const char *name, fault kind)
{
    FILE *const out = begin(name, 3);
    const char *const names =
        sweep_names[kind] != NULL ? sweep_names[kind] : "f (Hz),E' (MPa),E'' (MPa),T (degC)";
    if (kind == FLAGGED)
        fputs("Project:\tB\nTest:\tT7\nResult:\tFrequency sweep\n\n", out);
    else if (kind != LINES_ABOVE)
        fprintf(out, "%s\n", names);
    for (int i = 0; i < ISOTHERMS; i++) {
        const double celsius = -20 + 8 * i;
        if (kind == FLAGGED)
            fprintf(out, rheo_head, i + 1, FREQUENCIES);
        if (kind == LINES_ABOVE)
            fprintf(out, "%sTemperature: %g degC\n%s\n", i > 0 ? "\n" : "", celsius, names);
        const bool again = i == 3 && (kind == TWICE || kind == STIFFER);
        for (int copy = 0; copy <= again; copy++)
            for (int k = 0; k < FREQUENCIES * (kind == SPECIMENS ? 2 : 1); k++) {
                const int at = kind == SPECIMENS ? k / 2 : k;
                const double drift = kind == DRIFT ? -1.8 * (at - 4.5) / (FREQUENCIES - 1) : 0;
                point p = measure(celsius + drift, 0.1 * pow(10, at / 4.0), 0.005);
                p.storage *= copy == 1 ? 1.35 : 1;
                p.loss *= copy == 1 ? 1.35 : 1;
                put_row(out, kind, i, k, p);
            }
        if (kind == FLAGGED)
            fputc('\n', out);
    }
    fclose(out);
}

/* ---- friction -------------------------------------------------------------------------------- */

enum { SAMPLES = 1000 };

/* A running-in from 0.6 to 0.35 at 8 N. `offset` is the zero of the force, `spike` replaces a
 * sample, `before` and `after` are numbers of samples without load, `factor` scales the
 * coefficient. */
typedef struct record {
    const char *name;
    uint64_t seed;
    bool forces;
    double offset, spike, factor;
    int before, after;
} record;

static void write_record(const record *r)
{
    FILE *const out = begin(r->name, r->seed);
    fputs(r->forces ? "time (s),Ff (N),Fn (N)\n" : "time (s),COF\n", out);
    for (int i = -r->before; i < SAMPLES + r->after; i++) {
        const bool loaded = i >= 0 && i < SAMPLES;
        double mu = 0.35 + 0.25 * exp(-i / 90.0) + 0.008 * normal();
        const double load = loaded ? 8 * (1 + 0.002 * normal()) : 1e-3 * normal();
        if (i == 800 && r->spike != 0)
            mu = r->spike;
        fprintf(out, "%.6g", 0.2 * (i + r->before));
        if (r->forces)
            fprintf(out, ",%.6g,%.6g\n", r->offset + (loaded ? 8 * mu : 1e-3 * normal()), load);
        else
            fprintf(out, ",%.6g\n", (r->factor > 0 ? r->factor : 1) * mu);
    }
    fclose(out);
}

/* Strokes of 8 mm with friction 0.35 at 8 N and a force zero of 5 N. */
static void write_strokes(const char *name)
{
    FILE *const out = begin(name, 5);
    fputs("time (s),position (mm),Ff (N),Fn (N)\n", out);
    for (int i = 0; i < 3000; i++) {
        const double phase = 2 * M_PI * i / 100.0;
        const double way = tanh(8 * sin(phase));
        fprintf(out, "%.6g,%.6g,%.6g,%.6g\n", 0.02 * i, 4 * (1 - cos(phase)),
                5 + 8 * 0.35 * way * (1 + 0.01 * normal()), 8 * (1 + 0.002 * normal()));
    }
    fclose(out);
}

/* A running-in that is incomplete at the end of the record. */
static void write_slow(const char *name)
{
    FILE *const out = begin(name, 6);
    fputs("time (s),COF\n", out);
    for (int i = 0; i < 1200; i++)
        fprintf(out, "%.6g,%.6g\n", 0.5 * i, 0.35 + 0.3 * exp(-0.5 * i / 350) + 0.008 * normal());
    fclose(out);
}

/* A height profile of 2000 points at steps of 0.5 um; the rms height is about 20 nm. */
static void write_profile(const char *name, const char *names)
{
    FILE *const out = begin(name, 8);
    double height = 0, slope = 0;
    fprintf(out, "%s\n", names);
    for (int i = 0; i < 2000; i++) {
        slope = 0.7 * slope + normal();
        height = 0.97 * height + slope;
        fprintf(out, "%.6g,%.4f\n", 5e-4 * i, height);
    }
    fclose(out);
}

/* ---- force curves ---------------------------------------------------------------------------- */

/* A sphere of 4 um radius on a sample of 25 kPa (Poisson ratio 0.5); the spring constant is 0.12
 * N/m. */
static void write_curve(const char *name, const char *head)
{
    enum { POINTS = 500 };
    FILE *const out = begin(name, 9);
    const double stiffness = 4.0 / 3 * 25e3 / 0.75 * sqrt(4e-6), cantilever = 0.12;
    fprintf(out, "%sheight [m]\tdeflection [m]\n", head);
    for (int i = 0; i < POINTS; i++) {
        const double z = 5e-6 * (POINTS - 1 - i) / (POINTS - 1), way = 1.5e-6 - z;
        double low = 0, high = way > 0 ? way : 0; /* indentation d with F(d) = k (way - d) */
        for (int step = 0; step < 60; step++) {
            const double d = (low + high) / 2;
            if (stiffness * pow(d, 1.5) > cantilever * (way - d))
                high = d;
            else
                low = d;
        }
        fprintf(out, "%.6e\t%.5e\n", z, stiffness * pow(low, 1.5) / cantilever + 2e-11 * normal());
    }
    fclose(out);
}

/* ---- surfaces -------------------------------------------------------------------------------- */

enum { SIDE = 128 };

/* A self-affine surface as a sum of waves with random phases; steps of 0.1 um. */
static void write_map(const char *name, uint64_t seed, double offset, bool scars, const char *title)
{
    enum { WAVES = 400 };
    static float z[SIDE][SIDE];
    FILE *const out = begin(name, 7 + seed);
    memset(z, 0, sizeof z);
    for (int w = 0; w < WAVES; w++) {
        const double q = 2 * pow(28, uniform()), angle = 2 * M_PI * uniform();
        const int a = (int)lround(q * cos(angle)), b = (int)lround(q * sin(angle));
        const double phase = 2 * M_PI * uniform(), height = 2e-8 * pow(hypot(a, b) + 1, -0.8);
        for (int row = 0; row < SIDE; row++)
            for (int column = 0; column < SIDE; column++)
                z[row][column] +=
                    (float)(height * cos(2 * M_PI * (a * column + b * row) / SIDE + phase));
    }
    for (int row = 0; row < SIDE; row++) {
        const double shift = offset * normal();
        const bool scar = scars && row % 40 == 20;
        for (int column = 0; column < SIDE; column++)
            z[row][column] += (float)(shift + (scar && column > 30 && column < 90 ? 6e-7 : 0));
    }
    fprintf(out,
            "Gwyddion Simple Field 1.0\nXRes = %d\nYRes = %d\nXReal = 1.28e-5\nYReal = 1.28e-5\n"
            "XYUnits = m\nZUnits = m\nTitle = %s\n",
            SIDE, SIDE, title);
    do
        fputc(0, out);
    while (ftell(out) % 4 != 0);
    fwrite(z, sizeof z, 1, out);
    fclose(out);
}

/* A matrix of 20 x 15 pixels of 0.2 um, stated in the header; the file contains `rows` of them. */
static void write_matrix(const char *name, int rows, const char *end)
{
    FILE *const out = begin(name, 11);
    fputs("# Channel: Height\n# Width: 4 \u00b5m\n# Height: 3 \u00b5m\n# Value units: nm\n", out);
    for (int row = 0; row < rows; row++) {
        for (int column = 0; column < 20; column++)
            fprintf(out, "%s%.5e", column > 0 ? "\t" : "",
                    row == 4 && column == 7 ? -3.0 : 20 + 9 * sin(0.9 * row) * cos(0.4 * column));
        fputs(row + 1 < rows ? "\n" : end, out);
    }
    fclose(out);
}

static void write_wsxm(const char *name, const char *lateral, const char *range)
{
    enum { HEADER = 360, COLUMNS = 20, ROWS = 15 };
    FILE *const out = begin(name, 13);
    fprintf(out,
            "WSxM file copyright Nanotec Electronica\r\nSxM Image file\r\nImage header size: %d\r\n"
            "\r\n[Control]\r\n\r\n    X Amplitude: %s\r\n    Y Amplitude: %s\r\n\r\n[General Info]"
            "\r\n\r\n    Acquisition channel: Topography\r\n    Image Data Type: double\r\n"
            "    Number of columns: %d\r\n    Number of rows: %d\r\n    Z Amplitude: %s\r\n",
            HEADER, lateral, lateral, COLUMNS, ROWS, range);
    while (ftell(out) < HEADER)
        fputc(' ', out);
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        const double height = 10 * sin(0.1 * i);
        fwrite(&height, sizeof height, 1, out);
    }
    fclose(out);
}

int main(int argc, char *argv[])
{
    static const struct {
        const char *name;
        fault kind;
    } sweeps[] = {{"sound.csv", SOUND},
                  {"drift.csv", DRIFT},
                  {"flags.csv", FLAGGED},
                  {"angular.csv", ANGULAR_SAME},
                  {"tan.csv", TAN_DOUBLED},
                  {"redundant.csv", REDUNDANT},
                  {"specimens.csv", SPECIMENS},
                  {"oven.csv", OVEN},
                  {"twice.csv", TWICE},
                  {"milli.csv", MILLI},
                  {"radians.csv", RADIANS},
                  {"kelvin.csv", KELVIN},
                  {"negative.csv", NEGATIVE_LOSS},
                  {"stiffer.csv", STIFFER},
                  {"above.csv", LINES_ABOVE}};
    static const record records[] = {
        {.name = "record.csv", .seed = 1, .forces = true},
        {.name = "again.csv", .seed = 2, .forces = true},
        {.name = "copy.csv", .seed = 1, .forces = true},
        {.name = "high.csv", .seed = 1, .spike = 75},
        {.name = "low.csv", .seed = 1, .spike = -999},
        {.name = "end.csv", .seed = 1, .forces = true, .after = 90},
        {.name = "zero.csv", .seed = 1, .forces = true, .before = 100, .offset = 0.7},
        {.name = "percent.csv", .seed = 1, .factor = 100}};
    if (argc != 2) {
        fprintf(stderr, "usage: conditioning_files FOLDER\n");
        return 2;
    }
    folder = argv[1];
    for (size_t i = 0; i < sizeof sweeps / sizeof *sweeps; i++)
        write_sweep(sweeps[i].name, sweeps[i].kind);
    for (size_t i = 0; i < sizeof records / sizeof *records; i++)
        write_record(&records[i]);
    write_strokes("strokes.csv");
    write_slow("slow.csv");
    write_profile("profile.csv", "X (mm),Profile height (nm)");
    write_profile("way.csv", "Way,Depth");
    write_curve("curve.txt", "# spring constant: 0.12 N/m\n");
    write_curve("curve-2.txt", "# spring constant: 0.12 N/m\n");
    write_curve("titled.txt", "# exported again\n# spring constant: 0.12 N/m\n");
    write_curve("stiffer.txt", "# spring constant: 0.13 N/m\n");
    write_curve("two-springs.txt", "# spring constant: 0.24 N/m\n# spring constant: 0.12 N/m\n");
    write_map("map.gsf", 0, 0, false, "Height");
    write_map("map-2.gsf", 0, 0, false, "Height");
    write_map("titled.gsf", 0, 0, false, "Topography");
    write_map("offsets.gsf", 0, 4e-8, false, "Height");
    write_map("scars.gsf", 0, 0, true, "Height");
    write_matrix("whole.txt", 15, "\n");
    write_matrix("half.txt", 8, "\n");
    write_matrix("no-end.txt", 15, "");
    write_wsxm("micro.stp", "4 \xb5m", "20 nm");
    write_wsxm("angstrom.stp", "4000 nm", "200 \xc5");
    write_wsxm("nano.stp", "4000 nm", "20 nm");
    return 0;
}
