/// The larger and the smaller of finite numbers: fmax and fmin, which mind NaN, are calls, and where these
/// stand most of a search's time goes.
#ifndef HYST_HOST_EXTREMES_H
#define HYST_HOST_EXTREMES_H

static inline double larger(double a, double b)
{
    return a > b ? a : b;
}

static inline double smaller(double a, double b)
{
    return a < b ? a : b;
}

#endif
