set -g __lancer_commands render film view check info denoise merge verify slurm compare pixel study bench tune export options
# fish completion of lancer. Written by lancer options --pages.

# The command on the line; render where a scene stands in its place; nothing if there is none yet.
function __lancer_command
    set -l words (commandline -opc)
    set -e words[1]
    test (count $words) -gt 0; or return
    if contains -- $words[1] $__lancer_commands help
        echo $words[1]
    else
        echo render
    end
end
function __lancer_is
    set -l command (__lancer_command)
    test -n "$command"; and contains -- $command $argv
end
function __lancer_has_none
    test -z (__lancer_command)
end

# Files whose names end in one of these, and folders.
function __lancer_files
    for file in (__fish_complete_path (commandline -ct | string replace -r '^-[^=]*=' ''))
        set -l name (string split -m 1 \t -- $file)[1]
        if string match -q '*/' -- $name; or contains -- (string lower -- (string match -r '\.[^.]*$' -- $name)) $argv
            echo $file
        end
    end
end

# What goes on from the last comma.
function __lancer_list
    set -l before (commandline -ct | string replace -r '^--[^=]*=' '' | string replace -r '[^,]*$' '')
    for word in $argv
        echo $before$word
    end
end

complete -c lancer -f
complete -c lancer -n __lancer_has_none -a render -d 'render a scene (.toml) or a mesh (.obj, .ply, .gltf, .glb) into pictures'
complete -c lancer -n __lancer_has_none -a film -d 'render the frames of an animation or a turntable'
complete -c lancer -n __lancer_has_none -a view -d 'show a scene in a window and move camera and lights by hand'
complete -c lancer -n __lancer_has_none -a check -d 'print every problem of a scene and its files; nothing is rendered'
complete -c lancer -n __lancer_has_none -a info -d 'print what is in a scene, or what a picture says of its making'
complete -c lancer -n __lancer_has_none -a denoise -d 'remove the noise of a picture of lancer render --aov denoise'
complete -c lancer -n __lancer_has_none -a merge -d 'join the shards of a picture: lancer render --shard'
complete -c lancer -n __lancer_has_none -a verify -d 'trace pixels of a picture again and compare every bit'
complete -c lancer -n __lancer_has_none -a slurm -d 'print a job script for a Slurm cluster'
complete -c lancer -n __lancer_has_none -a compare -d 'print how far a picture is from a reference'
complete -c lancer -n __lancer_has_none -a pixel -d 'trace one sample again and print every vertex'
complete -c lancer -n __lancer_has_none -a study -d 'error against run time: methods on scenes, as one HTML page'
complete -c lancer -n __lancer_has_none -a bench -d 'speed of accelerators beside Embree on a mesh, as one HTML page'
complete -c lancer -n __lancer_has_none -a tune -d 'measure what each estimator gives on a scene'
complete -c lancer -n __lancer_has_none -a export -d 'write a scene for other renderers: JSON and plain meshes'
complete -c lancer -n __lancer_has_none -a options -d 'print the table of render settings, or of what biases pictures'
complete -c lancer -n __lancer_has_none -a help -d 'print the options of a command'
complete -c lancer -n __lancer_has_none -a '(__lancer_files .toml .obj .ply .gltf .glb .obj.gz .obj.xz .obj.zst .ply.gz .ply.xz .ply.zst)'
complete -c lancer -n __lancer_has_none -s h -l help -d 'Print the commands and exit'
complete -c lancer -n __lancer_has_none -l version -d 'Print versions and exit'
complete -c lancer -n '__lancer_is help' -a '$__lancer_commands'
complete -c lancer -n '__lancer_is render film view check info denoise merge verify slurm compare pixel study bench tune export options' -s h -l help -d 'Print this and exit'
complete -c lancer -n '__lancer_is render film view check info denoise merge verify slurm compare pixel study bench tune export options' -l version -d 'Print the versions of the program and its libraries and exit'
complete -c lancer -n '__lancer_is render film view check verify slurm pixel bench tune export' -k -a '(__lancer_files .toml .obj .ply .gltf .glb .obj.gz .obj.xz .obj.zst .ply.gz .ply.xz .ply.zst)'
complete -c lancer -n '__lancer_is render film view check info pixel bench tune export' -l camera -x -d 'Its [camera.NAME] ([camera])'
complete -c lancer -n '__lancer_is render film view check info pixel bench tune export' -l frame -x -d 'Frame of its [animation], or of --turntable (the first)'
complete -c lancer -n '__lancer_is render film view check info pixel bench tune export' -l turntable -x -d 'The camera turns around the scene in frames 0 to N-1: frame 0 is its own view'
complete -c lancer -n '__lancer_is render film view check info pixel bench tune export' -l env -x -a '(__lancer_files .exr .png .jpg .jpeg .hdr .tga .tif .tiff .webp .dds .gif .bmp .ppm .pgm .pfm)' -d 'Of a mesh: picture all around it, in place of the sky and the key light'
complete -c lancer -n '__lancer_is render film view check info pixel bench tune export' -l no-ground -d 'Of a mesh: no ground below it'
complete -c lancer -n '__lancer_is render film view check info pixel bench tune export' -l up -x -a 'y z auto' -d 'What is up, over camera.up; auto looks for what the mesh stands on (auto for a mesh, else y)'
complete -c lancer -n '__lancer_is render film view check info pixel bench tune export' -l view -x -a 'front back left right top' -d 'See all of it from there, over camera.position and camera.target; degrees from the front to the right, and above the horizon (by what there is to see)'
complete -c lancer -n '__lancer_is render film view check info pixel bench tune export' -s D -x -d 'A value over that of the scene file: camera.fov=35, light.0.radiance=[1,2,3]'
complete -c lancer -n '__lancer_is render film view check info pixel bench tune export' -l asset-root -x -a '(__fish_complete_directories)' -d 'Files that the scene names may lie anywhere in here (its own folder)'
complete -c lancer -n '__lancer_is render film view check info pixel bench tune export' -l smooth -x -a 'off' -d 'Normals of meshes without any: faces that meet at up to this angle share them'
complete -c lancer -n '__lancer_is render film view pixel tune export' -l size -x -d 'Width and height of the picture (1280x720 pixels)'
complete -c lancer -n '__lancer_is render film view pixel tune export' -s s -l spp -x -d 'How often each pixel is sampled (64 samples per pixel)'
complete -c lancer -n '__lancer_is render film view pixel tune export' -l seed -x -d 'Seed of the random numbers: another seed gives other noise (0)'
complete -c lancer -n '__lancer_is render film view pixel tune export' -l integrator -x -a 'path direct ao whitted random-decision' -d 'How light is computed (path)'
complete -c lancer -n '__lancer_is render film view pixel tune export' -l max-depth -x -d 'Longest path: 1 is direct light only, 0 no limit, for whitted and random-decision 7 (0 surface vertices)'
complete -c lancer -n '__lancer_is render film view pixel tune export' -l sampler -x -a 'sobol independent' -d 'Where sample points come from: Owen-scrambled Sobol points, or independent ones (sobol)'
complete -c lancer -n '__lancer_is render film view pixel tune export' -l filter -x -a 'box gaussian blackman-harris narrow-gaussian centre' -d 'Reconstruction filter of the pixels (blackman-harris)'
complete -c lancer -n '__lancer_is render film view pixel tune export' -l accel -x -a 'auto embree list list8 box median bvh2 bvh8' -d 'Ray-intersection backend: Embree, trees of our own, or lists of all primitives; auto is list8 for up to 64 triangles, bvh8 for long triangles at an angle and where things move, and a million instances, else Embree (auto)'
complete -c lancer -n '__lancer_is render film view pixel tune export' -l isa -x -a 'sse2 sse4.2 avx avx2 avx512' -d 'Instruction set of Embree; others round differently (avx2)'
complete -c lancer -n '__lancer_is render film view pixel tune export' -l legacy -d 'As --set legacy=true'
complete -c lancer -n '__lancer_is render film view pixel tune export' -l stop-error -x -d 'With stop: a pixel ends when the 95 % confidence interval of its mean reaches no further than this to either side (0.01 relative)'
complete -c lancer -n '__lancer_is render film view pixel tune export' -l replicates -x -d 'Independent replicates, to which the samples are dealt: they give the error with an interval, and may add noise (1)'
complete -c lancer -n '__lancer_is render film view pixel tune export' -l texture-limit -x -d 'Longest side of the pictures of textures: finer MIP levels are dropped, which saves memory; 0 is no limit (0 pixels)'
complete -c lancer -n '__lancer_is render film view pixel tune export' -l set -x -a "(__lancer_list nee=true nee=false mis=true mis=false direct=true direct=false indirect=true indirect=false emitters=true emitters=false fresnel=true fresnel=false soft_shadows=true soft_shadows=false straight_shadows=true straight_shadows=false always_nee=true always_nee=false mis_compensation=true mis_compensation=false learned_nee=true learned_nee=false mirror_nee=true mirror_nee=false light_tree=true light_tree=false split=true split=false roulette=true roulette=false stop=true stop=false multiscatter=true multiscatter=false terminator=true terminator=false compact=true compact=false legacy=true legacy=false)" -d 'Switches, here with their defaults'
complete -c lancer -n '__lancer_is render film view check info denoise merge verify pixel study bench tune export' -s t -l threads -x -d 'Threads; pictures do not depend on it (LANCER_THREADS, else all CPUs allowed)'
complete -c lancer -n '__lancer_is render film view check info verify pixel bench tune export' -l memory -x -d 'What all pictures of the scene may take together, MIP levels included: 4G, 500M, or a part of the memory that there is. More is refused (80%)'
complete -c lancer -n '__lancer_is render film view pixel tune export' -l strict -d 'Fail if loading the scene gives a warning'
complete -c lancer -n '__lancer_is render film' -l progress -x -a 'auto plain json none' -d 'auto is a line on a terminal, else plain (auto)'
complete -c lancer -n '__lancer_is render film' -l display-server -x -d 'Show the picture while it grows in tev, an image viewer that listens there (port 14158)'
complete -c lancer -n '__lancer_is render film' -l time -x -d 'Stop after T of rendering: 60s, 5m, 2h; loading does not count. Without -s only this stops'
complete -c lancer -n '__lancer_is render film' -l error -x -d 'Stop when the error, the root of the relative mean squared one, is estimated at X or less: 0.02. Without -s only this stops'
complete -c lancer -n '__lancer_is render film' -l tile -x -d 'Side of a tile in pixels; pictures do not depend on it (16)'
complete -c lancer -n '__lancer_is render film' -l batch -x -d 'Paths traced together; pictures do not depend on it (256)'
complete -c lancer -n '__lancer_is render film view' -s q -l quiet -d 'Only warnings and errors'
complete -c lancer -n '__lancer_is render film' -s v -l verbose -d 'Also say what was loaded and with what settings'
complete -c lancer -n '__lancer_is render' -s o -l output -x -a '(__lancer_files .exr .png .ppm .jpg .jpeg .hdr)' -d 'Picture, .exr, .png, .ppm, .jpg or .hdr; may be given several times (NAME.exr in this folder)'
complete -c lancer -n '__lancer_is render film denoise merge compare' -l format -x -a 'exr png ppm jpg hdr' -d 'What pictures are whose names have no ending: a pipe, or - for the standard output'
complete -c lancer -n '__lancer_is render' -l shard -x -a 'auto' -d 'Only part K of N of the picture, for lancer merge: -o names it, and it is its own checkpoint (NAME.%k-of-%n.lancer; %k and %n stand for K and N). auto: as Slurm, Open MPI or PMI say'
complete -c lancer -n '__lancer_is render' -l frames -x -d 'Scene files one after the other: #### in names stands for the number, 0001 for 1'
complete -c lancer -n '__lancer_is render film' -l crop -x -d 'Only these pixels; x1 and y1 are exclusive'
complete -c lancer -n '__lancer_is render film' -l aov -x -a "(__lancer_list albedo normal depth position uv material variance mask flat samples z all lights parts lobes cryptomatte denoise oidn)" -d 'More channels of EXR pictures: albedo|normal|depth|position|uv|material|variance|mask|flat|samples|z|all; also lights, a layer for each group of lights, parts, emission, direct and indirect light, lobes, light by diffuse and glossy reflection and by transmission, cryptomatte, which objects and materials a pixel shows, denoise, what lancer denoise needs, and oidn, what Open Image Denoise takes'
complete -c lancer -n '__lancer_is render film' -l background -x -a 'keep transparent opaque-glass' -d 'transparent: an alpha channel in EXR and PNG, and no sky where camera rays reach it, also through smooth glass; opaque-glass: glass shows the sky (keep)'
complete -c lancer -n '__lancer_is render film' -l denoise -d 'The picture is denoised when it is complete; EXR keeps the noisy one as layer noisy'
complete -c lancer -n '__lancer_is render film' -l layer-names -x -a 'lancer nuke blender' -d 'EXR: whose names the layers have (lancer)'
complete -c lancer -n '__lancer_is render film' -l half -d 'EXR with 16-bit floats; AOVs keep 32 bits'
complete -c lancer -n '__lancer_is render film' -l exr-compression -x -a 'none rle zips zip piz dwaa dwab' -d 'EXR: how it is compressed; dwaa and dwab lose what is hardly seen (zip)'
complete -c lancer -n '__lancer_is render film' -l exr-tiles -x -d 'EXR: tiles of N by N pixels, 16 to 1024, in place of scan lines'
complete -c lancer -n '__lancer_is render film' -l exr-multipart -d 'EXR: a part for each layer; R, G, B and A are the first'
complete -c lancer -n '__lancer_is render film' -l color-space -x -a 'lin_rec709 acescg' -d 'EXR: what its colours are, as the header says, too: linear Rec. 709 or ACEScg (lin_rec709)'
complete -c lancer -n '__lancer_is render film' -l no-metadata -d 'Pictures whose headers say nothing of how they were made'
complete -c lancer -n '__lancer_is render film' -l reproducible -d 'Pictures without times, threads and command line in their headers: of two runs the same bytes'
complete -c lancer -n '__lancer_is render film denoise' -l jpeg-quality -x -d 'JPEG: 1, small, to 100 (95)'
complete -c lancer -n '__lancer_is render film' -l tonemap -x -a 'srgb agx none gamma22 clamped' -d 'PNG, PPM and JPEG: the sRGB curve, cut off at 1; AgX, which rolls off; linear values; a power of 1/2.2 or no curve with steps that round down (srgb; with --legacy one of the last two)'
complete -c lancer -n '__lancer_is render film denoise' -l ocio -x -a '(__lancer_files .ocio .ocioz)' -d 'PNG, PPM and JPEG by a view of this OpenColorIO configuration, not by a tone map'
complete -c lancer -n '__lancer_is render film denoise' -l ocio-display -x -d 'Its display (the default of the configuration)'
complete -c lancer -n '__lancer_is render film denoise' -l ocio-view -x -d 'Its view (the default of the display)'
complete -c lancer -n '__lancer_is render film' -l ascii-ppm -d 'PPM as text'
complete -c lancer -n '__lancer_is render film' -l exposure -x -a 'auto' -d 'PNG, PPM and JPEG are brightened by 2^STOPS; auto: so that objects are of a middle brightness (0; of a mesh auto)'
complete -c lancer -n '__lancer_is render film' -l dither -d 'PNG, PPM and JPEG with a fixed dither pattern against banding'
complete -c lancer -n '__lancer_is render film' -l reference -x -a '(__lancer_files .exr)' -d 'Picture that the render is measured against as it goes'
complete -c lancer -n '__lancer_is render film' -l reference2 -x -a '(__lancer_files .exr)' -d 'A second one, independent of the first: their noise then cancels out'
complete -c lancer -n '__lancer_is render film' -l error-log -x -a '(__lancer_files .csv)' -d 'Seconds, rays and errors each time that samples have doubled, as CSV; with --denoise those of the denoised picture, and the seconds that it takes'
complete -c lancer -n '__lancer_is render film' -l outliers -x -d 'Also list the N samples with the largest part of the error, and what paths the error comes from'
complete -c lancer -n '__lancer_is render film' -l write-scene -x -a '(__lancer_files .toml)' -d 'The scene with what was added to it, and with these options: renders the same picture'
complete -c lancer -n '__lancer_is render film' -l stats -x -a '(__lancer_files .json)' -d 'Figures of the run as JSON'
complete -c lancer -n '__lancer_is render film' -l checkpoint -x -a '(__lancer_files .lancer)' -d 'Every T (60s), first after 10 s, and at the end write what --resume needs; the one before stays as FILE.old'
complete -c lancer -n '__lancer_is render film' -l resume -x -a 'auto (__lancer_files .lancer)' -d 'Go on from a checkpoint, with the same bits; also with more samples. auto: from the one of --checkpoint, if it is there'
complete -c lancer -n '__lancer_is film' -s o -l output -x -a '(__lancer_files .exr .png .ppm .jpg .jpeg .hdr .mp4)' -d 'Pictures of the frames, #### in their names stands for the number; a name in .mp4 is a movie, made by ffmpeg; may be given several times (NAME.####.exr in this folder)'
complete -c lancer -n '__lancer_is film' -l shard -x -a 'auto' -d 'Only each Nth frame, from the Kth on. auto: as Slurm, Open MPI or PMI say'
complete -c lancer -n '__lancer_is film' -l frames -x -d 'Only these frames (all)'
complete -c lancer -n '__lancer_is film' -l fps -x -d 'Of the movie: frames per second (as [animation] says, else 24)'
complete -c lancer -n '__lancer_is film' -l again -d 'Draw frames again that are finished'
complete -c lancer -n '__lancer_is view' -s v -l verbose -d 'At the end, say how long the hand waited for pictures'
complete -c lancer -n '__lancer_is view' -s o -l output -x -a '(__lancer_files .exr .png .ppm .jpg .jpeg .hdr)' -d 'What R, Shift+R, Ctrl+R and O write: .exr, .png, .ppm, .jpg or .hdr; may be given several times (output.png; with --legacy output.ppm)'
complete -c lancer -n '__lancer_is view' -l write-scene -x -a '(__lancer_files .toml)' -d 'What Ctrl+S writes (NAME.view.toml in this folder)'
complete -c lancer -n '__lancer_is view' -l path -x -a '(__lancer_files .toml)' -d 'Key frames: read at the beginning, if it is there, and written at the end (NAME.path.toml)'
complete -c lancer -n '__lancer_is view' -l tonemap -x -a 'srgb agx none gamma22 clamped' -d 'As of lancer render, to begin with'
complete -c lancer -n '__lancer_is view' -l exposure -x -a 'auto' -d 'As of lancer render, to begin with'
complete -c lancer -n '__lancer_is check' -l strict -d 'Exit with 65 if there is a warning'
complete -c lancer -n '__lancer_is check info merge verify compare' -l json -d 'The result as JSON: docs/json tells its keys'
complete -c lancer -n '__lancer_is info' -k -a '(__lancer_files .toml .obj .ply .gltf .glb .exr .png .jpg .jpeg .hdr .tga .tif .tiff .webp .dds .gif .bmp .ppm .pgm .pfm)'
complete -c lancer -n '__lancer_is info' -l plan -d 'Also what a pilot learns of the scene: splitting, where and which light is sampled'
complete -c lancer -n '__lancer_is info' -l plan-map -x -a '(__lancer_files .png)' -d 'That, and a map of how often light is sampled: white always, black never or nothing'
complete -c lancer -n '__lancer_is denoise verify' -k -a '(__lancer_files .exr)'
complete -c lancer -n '__lancer_is denoise' -s o -l output -x -a '(__lancer_files .exr .png .ppm .jpg .jpeg .hdr)' -d 'Denoised picture, .exr, .png, .ppm, .jpg or .hdr; may be given several times'
complete -c lancer -n '__lancer_is denoise' -l tonemap -x -a 'srgb agx none gamma22 clamped' -d 'PNG, PPM and JPEG: as of lancer render (srgb)'
complete -c lancer -n '__lancer_is denoise' -l exposure -x -d 'PNG, PPM and JPEG are brightened by 2^STOPS (0)'
complete -c lancer -n '__lancer_is merge' -k -a '(__lancer_files .lancer)'
complete -c lancer -n '__lancer_is merge' -s o -l output -x -a '(__lancer_files .exr .png .ppm .jpg .jpeg .hdr .lancer)' -d 'Picture, .exr, .png, .ppm, .jpg or .hdr, or all parts as one, .lancer; may be given several times'
complete -c lancer -n '__lancer_is merge' -l allow-missing -d 'Write the picture although parts are missing: black, and marked partial'
complete -c lancer -n '__lancer_is verify' -l pixels -x -a 'all' -d 'How many, drawn at random (200)'
complete -c lancer -n '__lancer_is verify' -l asset-root -x -a '(__fish_complete_directories)' -d 'Files that the scene names may lie anywhere in here (as the picture says)'
complete -c lancer -n '__lancer_is slurm' -s o -l output -x -a '(__lancer_files .exr .png .ppm .jpg .jpeg .hdr)' -d 'Picture, .exr, .png, .ppm, .jpg or .hdr (NAME.exr in this folder)'
complete -c lancer -n '__lancer_is slurm' -l shards -x -d 'Parts of each picture (1)'
complete -c lancer -n '__lancer_is slurm' -l frames -x -d 'Frames of an [animation], or numbered scene files, where the name of the scene has ####'
complete -c lancer -n '__lancer_is slurm' -l render -x -d 'More options of lancer render: --render=\'-s 4096 --aov albedo\''
complete -c lancer -n '__lancer_is compare' -k -a '(__lancer_files .exr .png .jpg .jpeg .hdr .tga .tif .tiff .webp .dds .gif .bmp .ppm .pgm .pfm)'
complete -c lancer -n '__lancer_is compare' -l reference2 -x -a '(__lancer_files .exr .png .jpg .jpeg .hdr .tga .tif .tiff .webp .dds .gif .bmp .ppm .pgm .pfm)' -d 'A second, independent reference: noise of the references cancels out'
complete -c lancer -n '__lancer_is compare' -l metric -x -a 'rmse relmse smape flip' -d 'What the limit is for (relmse; with two references its unbiased form)'
complete -c lancer -n '__lancer_is compare' -l steps -d 'Compare what 8-bit pictures hold, 0 to 255, as it stands in the files: no linear light'
complete -c lancer -n '__lancer_is compare' -l fail-above -x -d 'Exit with 1 if the error is above X or not a number'
complete -c lancer -n '__lancer_is compare' -s o -l output -x -a '(__lancer_files .exr .png .ppm .jpg .jpeg .hdr)' -d 'Map of the errors: .png, .ppm or .jpg in colours, .exr or .hdr as numbers; may be given several times'
complete -c lancer -n '__lancer_is compare' -l map -x -a 'flip relmse' -d 'What the map shows: FLIP from 0 to 1, or the relative squared error in powers of ten from 1e-5 to 10 (flip)'
complete -c lancer -n '__lancer_is study' -k -a '(__lancer_files .toml)'
complete -c lancer -n '__lancer_is study' -l allow-peers -d 'Let the study start the other programs that it names'
complete -c lancer -n '__lancer_is study' -s o -l output -x -a '(__fish_complete_directories)' -d 'Where pictures, figures and index.html go (named as the study)'
complete -c lancer -n '__lancer_is bench' -l time -x -d 'How long all of it takes: 120s, 5m (120s)'
complete -c lancer -n '__lancer_is bench' -l quick -d 'The same as --time 20s'
complete -c lancer -n '__lancer_is bench' -l accel -x -d 'Methods besides embree-robust: embree-robust|embree-fast|embree|list|list8|box|median|bvh2|bvh8 (embree-fast,bvh8,bvh2,median)'
complete -c lancer -n '__lancer_is bench' -l rays -x -d 'Kinds of rays: primary|shadow|ao|bounce1|bounce2|bounce3|random (all)'
complete -c lancer -n '__lancer_is bench' -l error -x -d 'Error of the picture, the root of a relative mean square (0.02)'
complete -c lancer -n '__lancer_is bench' -s o -l output -x -a '(__fish_complete_directories)' -d 'Write bench.html, bench.json (in the shape of Google Benchmark\'s) and bench.csv'
complete -c lancer -n '__lancer_is bench' -l against -x -d 'A folder or bench.json of the same mesh: which ratios differ'
complete -c lancer -n '__lancer_is bench' -l json -d 'Print bench.json, and nothing else, on the standard output'
complete -c lancer -n '__lancer_is bench' -s q -l quiet -d 'Only warnings, errors and results'
complete -c lancer -n '__lancer_is tune' -l time -x -d 'No round begins after T: 60s, 5m, 2h; at least three are drawn (30s)'
complete -c lancer -n '__lancer_is tune' -s q -l quiet -d 'Only warnings, errors and the result'
complete -c lancer -n '__lancer_is export' -s o -l output -x -a '(__fish_complete_directories)' -d 'Where to; made if it is not there'
complete -c lancer -n '__lancer_is options' -l biases -d 'The bias ledger instead: the entries of lancer:bias in picture headers'
complete -c lancer -n '__lancer_is options' -l pages -x -a '(__fish_complete_directories)' -d 'Instead write manual pages, completions of shells and docs/cli.md into FOLDER, for packages of lancer'
