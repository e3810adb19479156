# Plots of paper_study's tables: gnuplot -e "directory='DIR'" paper_study.gnuplot
terminal_kind = exists("png") ? "pngcairo noenhanced" : "svg noenhanced background rgb 'white'"
suffix = exists("png") ? ".png" : ".svg"
set grid lc rgb "#dddddd"
set border 3
set tics nomirror

# Weights before and after: what 30 plays weigh, and the 6 that stand for them.
set term @terminal_kind size 1000,1300 font ",12"
set output directory."/weights".suffix
set multiplot layout 5,1 margins 0.08,0.97,0.05,0.95 spacing 0.05
cases = "'uniform' 'one peak' 'two peaks' 'random' 'VO2-like'"
set yrange [0:*]
set xrange [0:1.02]
set ylabel "weight"
do for [i=0:4] {
    data = sprintf("%s/weights_%d.dat", directory, i)
    set title word(cases, i + 1) offset 0,-0.5
    if (i == 0) { set key outside top center horizontal } else { unset key }
    if (i == 4) { set xlabel "radius" } else { unset xlabel }
    plot data index 0 using 1:2 with boxes fill solid 0.35 lc rgb "#888888" title "30 plays", \
         data index 1 using ($1-0.004):2 with impulses lw 3 lc rgb "#0072b2" title "6: entropy-sum, unscaled", \
         data index 2 using 1:2 with impulses lw 3 lc rgb "#d55e00" title "6: wasserstein", \
         data index 3 using ($1+0.004):2 with impulses lw 3 lc rgb "#009e73" title "6: ensemble"
}
unset multiplot

# Error over the number of plays kept.
reset
set grid lc rgb "#dddddd"
set border 3
set tics nomirror
set term @terminal_kind size 1100,600 font ",12"
set output directory."/error".suffix
set multiplot layout 1,2 title "random weights, N = 30"
set logscale y
set xlabel "plays kept"
set xrange [0.7:10.3]
set xtics 1
methods = "'entropy-sum' 'entropy-sum, unscaled' 'entropy-max' 'entropy-max, unscaled' 'uniform' 'uniform, unscaled' 'wasserstein' 'variance' 'ensemble' 'fit to one input'"
colours = "#0072b2 #0072b2 #56b4e9 #56b4e9 #999999 #999999 #d55e00 #cc79a7 #009e73 #000000"
data = directory."/error.dat"
dashes = "1 2 1 2 1 2 1 1 1 3"
do for [field=2:3] {
    set ylabel field == 2 ? "mean RMSE over 50 random inputs, % of range" : "certified bound, % of range"
    if (field == 3) { set key top right } else { unset key }
    plot for [m=0:9] data index m using 1:field with linespoints pt (m % 2 == 0 || m > 5 ? 7 : 6) ps 0.6 lw 2 \
         dt 0 + word(dashes, m + 1) lc rgb word(colours, m + 1) title word(methods, m + 1)
}
unset multiplot

# Figs. 9 and 10.
reset
set grid lc rgb "#dddddd"
set border 3
set tics nomirror
set term @terminal_kind size 1000,450 font ",12"
set output directory."/search".suffix
set multiplot layout 1,2 title "N = 30, two peaks, entropy-sum"
set logscale y
set format y "10^{%L}"
set termoption enhanced
set xlabel "plays kept, M"
set key top left
data = directory."/search.dat"
set ylabel "groups evaluated"
plot data using 1:4 with linespoints pt 7 lw 2 lc rgb "#d55e00" title "exhaustive", \
     data using 1:2 with linespoints pt 7 lw 2 lc rgb "#0072b2" title "dynamic programming"
set ylabel "time, ms"
plot data using 1:5 with linespoints pt 7 lw 2 lc rgb "#d55e00" title "exhaustive", \
     data using 1:3 with linespoints pt 7 lw 2 lc rgb "#0072b2" title "dynamic programming"
unset multiplot
