# bash completion of lancer. Written by lancer options --pages.

# Words of COMP_WORDS, joined again where bash divided them at '='. Sets words, current (the last one, up to the
# cursor) and kept (what of it bash leaves in place).
_lancer_words() {
    local i part
    words=()
    for ((i = 0; i <= COMP_CWORD; i++)); do
        part=${COMP_WORDS[i]}
        if ((${#words[@]})) && [[ $part == =* || (i -gt 0 && ${COMP_WORDS[i - 1]} == =) ]]; then
            words[${#words[@]} - 1]+=$part
        else
            words+=("$part")
        fi
    done
    current=${words[${#words[@]} - 1]}
    part=${COMP_WORDS[COMP_CWORD]}
    if [[ $part == =* ]]; then kept=$current; else kept=${current%"$part"}; fi
}

# Offers words of $2 that go on from what follows the last comma or '=' of an option ($1: all before it).
_lancer_offer() {
    local word
    for word in $2; do
        if [[ $1$word == "$current"* ]]; then
            word=$1$word
            COMPREPLY+=("${word#"$kept"}")
        fi
    done
}

# Offers files below what is typed after $1 whose names end in one of $2 (all, if there is none), and folders.
_lancer_files() {
    local name ending typed=${current#"$1"}
    typed=${typed/#\~/$HOME}
    compopt -o filenames 2>/dev/null
    while IFS= read -r name; do
        ending=.${name##*.}
        if [[ -d $name || -z $2 || " $2 " == *" ${ending,,} "* ]]; then COMPREPLY+=("$name"); fi
    done < <(compgen -f -- "$typed")
}
_lancer_folders() {
    local name typed=${current#"$1"}
    compopt -o filenames 2>/dev/null
    while IFS= read -r name; do COMPREPLY+=("$name"); done < <(compgen -d -- "$typed")
}

# Offers what the tables say of a value. $1: what stands before it.
_lancer_value() {
    local before=$1
    if [[ -n $list ]]; then
        local typed=${current#"$before"}
        [[ $typed != *,* ]] || before+=${typed%,*},
        _lancer_offer "$before" "$list"
        compopt -o nospace 2>/dev/null
        return
    fi
    _lancer_offer "$before" "$values"
    [[ -z $files ]] || _lancer_files "$before" "${files#any}"
    [[ -z $folders ]] || _lancer_folders "$before"
}

_lancer() {
    local words current kept i first=2 name=render place=0 option='' only_arguments=''
    local values='' list='' files='' folders='' takes='' options='' arguments=0
    COMPREPLY=()
    _lancer_words
    local last=$((${#words[@]} - 1))
    if ((last == 1)) && [[ $current != -* ]]; then
        _lancer_offer '' "$_lancer_commands help"
        _lancer_files '' "$_lancer_scenes"
        return
    fi
    if ((last > 1)) && [[ ${words[1]} == help ]]; then
        ((last > 2)) || _lancer_offer '' "$_lancer_commands"
        return
    fi
    if ((last > 1)) && [[ " $_lancer_commands " == *" ${words[1]} "* ]]; then name=${words[1]}; else first=1; fi
    for ((i = first; i < last; i++)); do
        if [[ -n $only_arguments || ${words[i]} != -* || ${words[i]} == - ]]; then
            place=$((place + 1))
        elif [[ ${words[i]} == -- ]]; then
            only_arguments=yes
        elif [[ ${words[i]} != *=* ]]; then
            takes=
            _lancer_option "$name" "${words[i]}"
            if [[ -n $takes ]]; then
                if ((i + 1 == last)); then option=${words[i]}; else i=$((i + 1)); fi
            fi
        fi
    done
    values='' list='' files='' folders=''
    if [[ -n $option ]]; then
        _lancer_option "$name" "$option"
        _lancer_value ''
    elif [[ -z $only_arguments && $current == --*=* ]]; then
        _lancer_option "$name" "${current%%=*}"
        _lancer_value "${current%%=*}="
    elif [[ -z $only_arguments && $current == -* ]]; then
        _lancer_options "$name"
        _lancer_offer '' "$options"
    else
        _lancer_argument "$name" "$place"
        _lancer_value ''
    fi
}
complete -F _lancer lancer

_lancer_commands='render film view check info denoise merge verify slurm compare pixel study bench tune export options'
_lancer_scenes='.toml .obj .ply .gltf .glb .obj.gz .obj.xz .obj.zst .ply.gz .ply.xz .ply.zst'

_lancer_options() {
    case $1 in
        render) options='-h --help --version --camera --frame --turntable --env --no-ground --up --view -D --asset-root --smooth --size -s --spp --seed --integrator --max-depth --sampler --filter --accel --isa --legacy --stop-error --replicates --texture-limit --set -t --threads --memory --strict --progress --display-server --time --error --tile --batch -q --quiet -v --verbose -o --output --format --shard --frames --crop --aov --background --denoise --layer-names --half --exr-compression --exr-tiles --exr-multipart --color-space --no-metadata --reproducible --jpeg-quality --tonemap --ocio --ocio-display --ocio-view --ascii-ppm --exposure --dither --reference --reference2 --error-log --outliers --write-scene --stats --checkpoint --resume' ;;
        film) options='-h --help --version --camera --frame --turntable --env --no-ground --up --view -D --asset-root --smooth --size -s --spp --seed --integrator --max-depth --sampler --filter --accel --isa --legacy --stop-error --replicates --texture-limit --set -t --threads --memory --strict --progress --display-server --time --error --tile --batch -q --quiet -v --verbose -o --output --format --shard --frames --crop --aov --background --denoise --layer-names --half --exr-compression --exr-tiles --exr-multipart --color-space --no-metadata --reproducible --jpeg-quality --tonemap --ocio --ocio-display --ocio-view --ascii-ppm --exposure --dither --reference --reference2 --error-log --outliers --write-scene --stats --checkpoint --resume --fps --again' ;;
        view) options='-h --help --version --camera --frame --turntable --env --no-ground --up --view -D --asset-root --smooth --size -s --spp --seed --integrator --max-depth --sampler --filter --accel --isa --legacy --stop-error --replicates --texture-limit --set -t --threads --memory --strict -q --quiet -v --verbose -o --output --write-scene --path --tonemap --exposure' ;;
        check) options='-h --help --version --camera --frame --turntable --env --no-ground --up --view -D --asset-root --smooth -t --threads --memory --strict --json' ;;
        info) options='-h --help --version --camera --frame --turntable --env --no-ground --up --view -D --asset-root --smooth -t --threads --memory --plan --plan-map --json' ;;
        denoise) options='-h --help --version -o --output --format --jpeg-quality --tonemap --exposure --ocio --ocio-display --ocio-view -t --threads' ;;
        merge) options='-h --help --version -o --output --format --allow-missing -t --threads --json' ;;
        verify) options='-h --help --version --pixels --asset-root -t --threads --memory --json' ;;
        slurm) options='-h --help --version -o --output --shards --frames --render' ;;
        compare) options='-h --help --version --reference2 --metric --steps --fail-above -o --output --format --map --json' ;;
        pixel) options='-h --help --version --camera --frame --turntable --env --no-ground --up --view -D --asset-root --smooth --size -s --spp --seed --integrator --max-depth --sampler --filter --accel --isa --legacy --stop-error --replicates --texture-limit --set -t --threads --memory --strict' ;;
        study) options='-h --help --version --allow-peers -o --output -t --threads' ;;
        bench) options='-h --help --version --camera --frame --turntable --env --no-ground --up --view -D --asset-root --smooth --time --quick --accel --rays --error -o --output --against --json -q --quiet -t --threads --memory' ;;
        tune) options='-h --help --version --camera --frame --turntable --env --no-ground --up --view -D --asset-root --smooth --size -s --spp --seed --integrator --max-depth --sampler --filter --accel --isa --legacy --stop-error --replicates --texture-limit --set -t --threads --memory --strict --time -q --quiet' ;;
        export) options='-h --help --version --camera --frame --turntable --env --no-ground --up --view -D --asset-root --smooth --size -s --spp --seed --integrator --max-depth --sampler --filter --accel --isa --legacy --stop-error --replicates --texture-limit --set -t --threads --memory --strict -o --output' ;;
        options) options='-h --help --version --biases --pages' ;;
    esac
}

# _lancer_argument COMMAND PLACE, from 0 on
_lancer_argument() {
    case $1:$2 in
        render:0) takes=yes files='.toml .obj .ply .gltf .glb .obj.gz .obj.xz .obj.zst .ply.gz .ply.xz .ply.zst' ;;
        film:0) takes=yes files='.toml .obj .ply .gltf .glb .obj.gz .obj.xz .obj.zst .ply.gz .ply.xz .ply.zst' ;;
        view:0) takes=yes files='.toml .obj .ply .gltf .glb .obj.gz .obj.xz .obj.zst .ply.gz .ply.xz .ply.zst' ;;
        check:0) takes=yes files='.toml .obj .ply .gltf .glb .obj.gz .obj.xz .obj.zst .ply.gz .ply.xz .ply.zst' ;;
        info:0) takes=yes files='.toml .obj .ply .gltf .glb .exr .png .jpg .jpeg .hdr .tga .tif .tiff .webp .dds .gif .bmp .ppm .pgm .pfm' ;;
        denoise:0) takes=yes files='.exr' ;;
        merge:*) takes=yes files='.lancer' ;;
        verify:0) takes=yes files='.exr' ;;
        verify:1) takes=yes files='.toml .obj .ply .gltf .glb .obj.gz .obj.xz .obj.zst .ply.gz .ply.xz .ply.zst' ;;
        slurm:0) takes=yes files='.toml .obj .ply .gltf .glb .obj.gz .obj.xz .obj.zst .ply.gz .ply.xz .ply.zst' ;;
        compare:0) takes=yes files='.exr .png .jpg .jpeg .hdr .tga .tif .tiff .webp .dds .gif .bmp .ppm .pgm .pfm' ;;
        compare:1) takes=yes files='.exr .png .jpg .jpeg .hdr .tga .tif .tiff .webp .dds .gif .bmp .ppm .pgm .pfm' ;;
        compare:2) takes=yes files='.exr .png .jpg .jpeg .hdr .tga .tif .tiff .webp .dds .gif .bmp .ppm .pgm .pfm' ;;
        pixel:0) takes=yes files='.toml .obj .ply .gltf .glb .obj.gz .obj.xz .obj.zst .ply.gz .ply.xz .ply.zst' ;;
        pixel:1) takes=yes ;;
        pixel:2) takes=yes ;;
        pixel:3) takes=yes ;;
        study:0) takes=yes files='.toml' ;;
        bench:0) takes=yes files='.toml .obj .ply .gltf .glb .obj.gz .obj.xz .obj.zst .ply.gz .ply.xz .ply.zst' ;;
        tune:0) takes=yes files='.toml .obj .ply .gltf .glb .obj.gz .obj.xz .obj.zst .ply.gz .ply.xz .ply.zst' ;;
        export:0) takes=yes files='.toml .obj .ply .gltf .glb .obj.gz .obj.xz .obj.zst .ply.gz .ply.xz .ply.zst' ;;
    esac
}

# What an option takes: _lancer_option COMMAND OPTION
_lancer_option() {
    case $1:$2 in
        bench:--accel) takes=yes ;;
        render:--accel | film:--accel | view:--accel | pixel:--accel | tune:--accel | export:--accel) takes=yes values='auto embree list list8 box median bvh2 bvh8' ;;
        *:--against) takes=yes ;;
        *:--aov) takes=yes list='albedo normal depth position uv material variance mask flat samples z all lights parts lobes cryptomatte denoise oidn' ;;
        *:--asset-root) takes=yes folders='yes' ;;
        *:--background) takes=yes values='keep transparent opaque-glass' ;;
        *:--batch) takes=yes ;;
        *:--camera) takes=yes ;;
        *:--checkpoint) takes=yes files='.lancer' ;;
        *:--color-space) takes=yes values='lin_rec709 acescg' ;;
        *:--crop) takes=yes ;;
        *:--display-server) takes=yes ;;
        *:--env) takes=yes files='.exr .png .jpg .jpeg .hdr .tga .tif .tiff .webp .dds .gif .bmp .ppm .pgm .pfm' ;;
        *:--error) takes=yes ;;
        *:--error-log) takes=yes files='.csv' ;;
        denoise:--exposure) takes=yes ;;
        render:--exposure | film:--exposure | view:--exposure) takes=yes values='auto' ;;
        *:--exr-compression) takes=yes values='none rle zips zip piz dwaa dwab' ;;
        *:--exr-tiles) takes=yes ;;
        *:--fail-above) takes=yes ;;
        *:--filter) takes=yes values='box gaussian blackman-harris narrow-gaussian centre' ;;
        *:--format) takes=yes values='exr png ppm jpg hdr' ;;
        *:--fps) takes=yes ;;
        *:--frame) takes=yes ;;
        *:--frames) takes=yes ;;
        *:--integrator) takes=yes values='path direct ao whitted random-decision' ;;
        *:--isa) takes=yes values='sse2 sse4.2 avx avx2 avx512' ;;
        *:--jpeg-quality) takes=yes ;;
        *:--layer-names) takes=yes values='lancer nuke blender' ;;
        *:--map) takes=yes values='flip relmse' ;;
        *:--max-depth) takes=yes ;;
        *:--memory) takes=yes ;;
        *:--metric) takes=yes values='rmse relmse smape flip' ;;
        *:--ocio) takes=yes files='.ocio .ocioz' ;;
        *:--ocio-display) takes=yes ;;
        *:--ocio-view) takes=yes ;;
        *:--outliers) takes=yes ;;
        *:--pages) takes=yes folders='yes' ;;
        *:--path) takes=yes files='.toml' ;;
        *:--pixels) takes=yes values='all' ;;
        *:--plan-map) takes=yes files='.png' ;;
        *:--progress) takes=yes values='auto plain json none' ;;
        *:--rays) takes=yes ;;
        *:--reference) takes=yes files='.exr' ;;
        compare:--reference2) takes=yes files='.exr .png .jpg .jpeg .hdr .tga .tif .tiff .webp .dds .gif .bmp .ppm .pgm .pfm' ;;
        render:--reference2 | film:--reference2) takes=yes files='.exr' ;;
        *:--render) takes=yes ;;
        *:--replicates) takes=yes ;;
        *:--resume) takes=yes values='auto' files='.lancer' ;;
        *:--sampler) takes=yes values='sobol independent' ;;
        *:--seed) takes=yes ;;
        *:--set) takes=yes list='nee=true nee=false mis=true mis=false direct=true direct=false indirect=true indirect=false emitters=true emitters=false fresnel=true fresnel=false soft_shadows=true soft_shadows=false straight_shadows=true straight_shadows=false always_nee=true always_nee=false mis_compensation=true mis_compensation=false learned_nee=true learned_nee=false mirror_nee=true mirror_nee=false light_tree=true light_tree=false split=true split=false roulette=true roulette=false stop=true stop=false multiscatter=true multiscatter=false terminator=true terminator=false compact=true compact=false legacy=true legacy=false' ;;
        *:--shard) takes=yes values='auto' ;;
        *:--shards) takes=yes ;;
        *:--size) takes=yes ;;
        *:--smooth) takes=yes values='off' ;;
        *:--stats) takes=yes files='.json' ;;
        *:--stop-error) takes=yes ;;
        *:--texture-limit) takes=yes ;;
        *:--tile) takes=yes ;;
        *:--time) takes=yes ;;
        *:--tonemap) takes=yes values='srgb agx none gamma22 clamped' ;;
        *:--turntable) takes=yes ;;
        *:--up) takes=yes values='y z auto' ;;
        *:--view) takes=yes values='front back left right top' ;;
        *:--write-scene) takes=yes files='.toml' ;;
        *:-D) takes=yes ;;
        merge:-o | merge:--output) takes=yes files='.exr .png .ppm .jpg .jpeg .hdr .lancer' ;;
        film:-o | film:--output) takes=yes files='.exr .png .ppm .jpg .jpeg .hdr .mp4' ;;
        render:-o | view:-o | denoise:-o | slurm:-o | compare:-o | render:--output | view:--output | denoise:--output | slurm:--output | compare:--output) takes=yes files='.exr .png .ppm .jpg .jpeg .hdr' ;;
        study:-o | bench:-o | export:-o | study:--output | bench:--output | export:--output) takes=yes folders='yes' ;;
        *:-s | *:--spp) takes=yes ;;
        *:-t | *:--threads) takes=yes ;;
    esac
}
