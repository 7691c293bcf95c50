/* Writes the expected numbers of friction cases in quad precision by friction_truth.h: truth FILE
 * [CASE] > NEW. Expected numbers of the file are dropped. */
#define FRICTION_TRUTH_QUAD
#include "numeric/friction_truth.h"

static void print_value(const char *name, real value)
{
    char text[64];
    quadmath_snprintf(text, sizeof text, "%.20Qg", value);
    printf("expect %s %s\n", name, text);
}

/* Copies lines up to the next case, without expected numbers; `quiet` skips them. */
static void copy_lines(FILE *in, bool quiet)
{
    char text[4096];
    bool begun = false;
    long at = ftell(in);
    while (fgets(text, sizeof text, in)) {
        const bool is_case = strncmp(text, "case ", 5) == 0;
        if (is_case && begun) {
            fseek(in, at, SEEK_SET);
            return;
        }
        begun = begun || is_case;
        at = ftell(in);
        if (!quiet && strcmp(text, "\n") != 0 &&
            (strncmp(text, "expect ", 7) != 0 || strncmp(text, "expect refused", 14) == 0))
            fputs(text, stdout);
    }
}

int main(int argc, char **argv)
{
    static numeric_case c;
    static case_scene made;
    FILE *in = argc >= 2 ? fopen(argv[1], "r") : NULL;
    FILE *lines = argc >= 2 ? fopen(argv[1], "r") : NULL;
    if (in == NULL || lines == NULL) {
        fprintf(stderr, "truth FILE [CASE]\n");
        return 2;
    }
    make_rule();
    while (case_read(in, &c)) {
        const bool quiet = argc > 2 && strcmp(argv[2], c.name) != 0;
        copy_lines(lines, quiet);
        if (quiet)
            continue;
        if (case_find(&c, true, "refused") == NULL) {
            case_to_scene(&c, &made);
            const truth t = truth_of(&made.s);
            print_value("stress_variance", t.variance);
            print_value("area_ratio", area(t.variance));
            print_value("one_minus_area", FN(erfc)(1 / (2 * FN(sqrt)(t.variance))));
            print_value("hysteresis", t.hysteresis);
        }
        printf("\n");
        fflush(stdout);
    }
    fclose(lines);
    fclose(in);
    return 0;
}
